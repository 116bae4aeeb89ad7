// How many steps a run asks of its simulation in one call. Between two calls it looks at the signal flag, writes rows,
// shows progress and saves a checkpoint, so a call must be short; but each costs a device one synchronisation and a
// copy of its rows, so fast steps go together.
#pragma once

#include <algorithm>
#include <cstdint>

namespace ogc::experiments {

/// How many steps to take before the next look at signals and clocks.
class Pace {
 public:
  /// A call takes about so long [s]: steps that become four times slower from one call to the next, as where contacts
  /// begin, still end within a second.
  static constexpr double seconds_a_call = 0.25;
  /// However fast steps are: what a resident simulation enqueues at once (fast/stages/simulation.hpp).
  static constexpr std::int64_t most_steps = 64;

  /// How many steps the next call takes; 1 where nothing is known yet.
  std::int64_t steps() const { return steps_; }
  /// The last call did so many steps in so much time.
  void measured(std::int64_t steps, double seconds) {
    const double whole = seconds > 0 ? seconds_a_call * static_cast<double>(steps) / seconds : most_steps;
    steps_ = static_cast<std::int64_t>(std::clamp(whole, 1.0, static_cast<double>(most_steps)));
  }

 private:
  std::int64_t steps_ = 1;
};

}  // namespace ogc::experiments
