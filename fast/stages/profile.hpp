// Measures the time of each stage by synchronising where it begins and ends. Without `profile` it only calls the stage.
// Stages may be nested; the time of an inner stage does not count for the outer stage. Where the ends of iterations are
// measured, it synchronises there, too.
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

/// Times from the start of a step to the end of each detection, and to the start of its first iteration and the end of
/// each [ms].
struct EventEnds {
  std::vector<double> detections, iterations;
};

template <class Backend>
class StageClock {
 public:
  /// `on`: whether it measures stages; `by_iteration`: if so, whether it also measures where iterations end.
  StageClock(Backend& backend, bool on, bool by_iteration = false)
      : backend_(backend), on_(on), by_iteration_(on && by_iteration) {}
  /// Returns whether the clock measures anything.
  bool on() const { return on_; }
  /// Returns whether it measures where iterations end.
  bool by_iteration() const { return by_iteration_; }

  /// Begins a step.
  void begin_step() {
    if (!on_) return;
    change_to(running_);
    since_begin_ = 0;
    ends_ = {};
  }
  /// Notes the start of the first iteration (`done` = 0), or the end of the last of `done` iterations, if it is not
  /// noted yet.
  void end_iteration(int done) {
    if (!by_iteration_ || static_cast<std::size_t>(done) != ends_.iterations.size()) return;
    change_to(running_);
    ends_.iterations.push_back(since_begin_);
  }

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
  /// Returns the ends of the events since begin_step, if iterations are measured, and forgets them.
  EventEnds take_ends() { return std::exchange(ends_, {}); }

 private:
  static constexpr std::size_t none = 6;  ///< index of the time outside all stages

  /// Adds the time since the last call to the current stage, and makes `next` the current stage. Returns the previous
  /// stage.
  std::size_t change_to(std::size_t next) {
    backend_.synchronize();
    const auto now = std::chrono::steady_clock::now();
    const double passed = std::chrono::duration<double, std::milli>(now - since_).count();
    milliseconds_[running_] += passed;
    since_begin_ += passed;
    since_ = now;
    if (by_iteration_ && running_ == static_cast<std::size_t>(StepStage::detection) && next != running_)
      ends_.detections.push_back(since_begin_);
    return std::exchange(running_, next);
  }

  Backend& backend_;
  bool on_, by_iteration_;
  std::size_t running_ = none;
  std::chrono::steady_clock::time_point since_{};
  std::array<double, none + 1> milliseconds_{};
  double since_begin_ = 0;  ///< time since begin_step, up to since_ [ms]
  EventEnds ends_;
};

}  // namespace ogc::fast
