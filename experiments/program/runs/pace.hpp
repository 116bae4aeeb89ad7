// Decides how many steps a run requests of its simulation in one call. Between two calls the run checks for signals,
// writes rows, shows progress and saves a checkpoint, so a call must be short. Each call costs a device one
// synchronisation and a copy of its rows, so that several fast steps share a call.
#pragma once

#include <algorithm>
#include <cstdint>

namespace ogc::experiments {

/// Counts the steps until signals and clocks are checked again.
class Pace {
 public:
  /// Duration of a call [s]. Even if steps become four times slower from one call to the next, as when contacts begin,
  /// the call ends within a second.
  static constexpr double seconds_a_call = 0.25;
  /// Largest number of steps in a call: what a resident simulation enqueues at once (fast/stages/simulation.hpp).
  static constexpr std::int64_t most_steps = 64;

  /// Returns the number of steps of the next call; 1 before the first measurement.
  std::int64_t steps() const { return steps_; }
  /// Records that the last call did so many steps in so much time.
  void measured(std::int64_t steps, double seconds) {
    const double whole = seconds > 0 ? seconds_a_call * static_cast<double>(steps) / seconds : most_steps;
    steps_ = static_cast<std::int64_t>(std::clamp(whole, 1.0, static_cast<double>(most_steps)));
  }

 private:
  std::int64_t steps_ = 1;
};

}  // namespace ogc::experiments
