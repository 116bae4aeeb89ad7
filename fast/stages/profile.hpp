// Times by stage, by synchronising where one begins and ends; without `profile` nothing but the call itself. Stages may
// stand inside each other: the time of the inner one is not the outer one's.
#pragma once

#include <array>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace ogc::fast {

/// What `--profile` tells apart.
enum class StepStage : int { begin, detection, initial_guess, sweep, metrics, volumes };

/// Their names, in the order of the enumeration.
inline std::vector<std::string> step_stage_names() {
  return {"begin", "detection", "initial_guess", "sweep", "metrics", "volumes"};
}

/// The clock of one simulation.
template <class Backend>
class StageClock {
 public:
  /// `on`: whether it measures anything.
  StageClock(Backend& backend, bool on) : backend_(backend), on_(on) {}
  /// Whether it measures anything.
  bool on() const { return on_; }

  /// body(), as a part of the stage.
  template <class Body>
  void time(StepStage stage, Body body) {
    if (!on_) return body();
    const std::size_t outer = change_to(static_cast<std::size_t>(stage));
    body();
    change_to(outer);
  }

  /// Times since the last call [ms], in the order of step_stage_names.
  std::vector<double> take() {
    std::vector<double> result(milliseconds_.begin(), milliseconds_.begin() + none);
    milliseconds_.fill(0);
    return result;
  }

 private:
  static constexpr std::size_t none = 6;  ///< no stage

  /// Ends what has been measured so far and begins to measure `next`; returns what was measured.
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
