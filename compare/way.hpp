// Which way a step took: what a proof of motion asks (compare/meetings.md).
#pragma once

#include <vector>

#include "compare/contestant.hpp"

namespace ogc::compare {

/// A simulation that can say it. One that can't is asked for a trace (Contestant::step), which starts another
/// simulation for each step.
class WayTeller {
 public:
  virtual ~WayTeller() = default;
  /// One step: the row of Simulation::advance(1), and `states`, by detection X_prev [m]. Changes no bit; the time of
  /// the row has the looks in it.
  virtual std::vector<StepMetrics> advance_telling(std::vector<std::vector<Vec3f>>& states) = 0;
};

}  // namespace ogc::compare
