// Measures the time of each stage by synchronising where it begins and ends. Without `profile` it only calls the stage.
// Stages may be nested; the time of an inner stage does not count for the outer stage.
#pragma once

#include <array>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace ogc::fast {

/// The stages that `--profile` measures.
enum class StepStage : int { begin, detection, initial_guess, sweep, metrics, volumes };

/// Returns the names of the stages, in the order of the enumeration.
inline std::vector<std::string> step_stage_names() {
  return {"begin", "detection", "initial_guess", "sweep", "metrics", "volumes"};
}

template <class Backend>
class StageClock {
 public:
  StageClock(Backend& backend, bool on) : backend_(backend), on_(on) {}
  /// Returns whether the clock measures anything.
  bool on() const { return on_; }

  /// Runs body() and adds its time to the stage.
  template <class Body>
  void time(StepStage stage, Body body) {
    if (!on_) return body();
    const std::size_t outer = change_to(static_cast<std::size_t>(stage));
    body();
    change_to(outer);
  }

  /// Returns the times since the last call [ms], in the order of step_stage_names, and resets them.
  std::vector<double> take() {
    std::vector<double> result(milliseconds_.begin(), milliseconds_.begin() + none);
    milliseconds_.fill(0);
    return result;
  }

 private:
  static constexpr std::size_t none = 6;  ///< index of the time outside all stages

  /// Adds the time since the last call to the current stage, and makes `next` the current stage. Returns the previous
  /// stage.
  std::size_t change_to(std::size_t next) {
    backend_.synchronize();
    const auto now = std::chrono::steady_clock::now();
    milliseconds_[running_] += std::chrono::duration<double, std::milli>(now - since_).count();
    since_ = now;
    return std::exchange(running_, next);
  }

  Backend& backend_;
  bool on_;
  std::size_t running_ = none;
  std::chrono::steady_clock::time_point since_{};
  std::array<double, none + 1> milliseconds_{};
};

}  // namespace ogc::fast
