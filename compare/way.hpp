// Lets a simulation report the motion of a step, for the proof that no faces met during it (compare/meetings.md).
#pragma once

#include <vector>

#include "compare/contestant.hpp"

namespace ogc::compare {

/// A simulation that can report the motion of its steps. For any other simulation the trace of a step is used
/// (Contestant::step), which starts another simulation for each step.
class WayTeller {
 public:
  virtual ~WayTeller() = default;
  /// Runs one step as Simulation::advance(1) does, with the same result bit for bit, and returns its row. Sets `states`
  /// to X_prev [m] of each detection. The time of the row includes the copies of these states.
  virtual std::vector<StepMetrics> advance_telling(std::vector<std::vector<Vec3f>>& states) = 0;
};

}  // namespace ogc::compare
