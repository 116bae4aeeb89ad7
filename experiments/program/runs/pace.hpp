// Decides how many steps a run requests from its simulation in one call. Between two calls the run checks for signals,
// writes rows, shows progress and saves checkpoints, so calls must be short. On a device each call costs a
// synchronisation and a copy of its rows, so several fast steps share a call.
#pragma once

#include <algorithm>
#include <cstdint>

namespace ogc::experiments {

/// Computes the number of steps for the next call.
class Pace {
 public:
  /// Target duration of a call [s]. If steps become four times slower between two calls, for example when contacts
  /// begin, the call still ends within a second.
  static constexpr double seconds_a_call = 0.25;
  /// Largest number of steps in a call: the number that a resident simulation enqueues at once
  /// (fast/stages/simulation.hpp).
  static constexpr std::int64_t most_steps = 64;

  /// Returns the number of steps for the next call; 1 before the first measurement.
  std::int64_t steps() const { return steps_; }
  /// Records the steps and the duration of the last call.
  void measured(std::int64_t steps, double seconds) {
    const double whole = seconds > 0 ? seconds_a_call * static_cast<double>(steps) / seconds : most_steps;
    steps_ = static_cast<std::int64_t>(std::clamp(whole, 1.0, static_cast<double>(most_steps)));
  }

 private:
  std::int64_t steps_ = 1;
};

}  // namespace ogc::experiments
