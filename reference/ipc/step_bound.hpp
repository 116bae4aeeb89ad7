// Computes the share of a displacement by which all vertices may move before the first pair meets.
#pragma once

#include <optional>

#include "reference/ipc/pairs.hpp"

namespace ogc::reference {

/// The bound of a move.
struct StepBound {
  double share = 1;  ///< share of the direction, in [0, 1]; up to it all pairs stay farther apart than `thickness`
  std::optional<PrimitivePair> pair;  ///< the pair that gives this bound, if any
};

/// Runs additive CCD of each pair from x along `direction` [m]. Returns the smallest time, or `until` if no time is
/// smaller. The result does not depend on the number of threads.
StepBound step_bound(const PairMesh& mesh, const std::vector<PrimitivePair>& pairs, const State& x,
                     const State& direction, double thickness, double until = 1);

/// Returns ‖p_v‖ of the fastest vertex [m].
double largest_motion(const State& direction);

}  // namespace ogc::reference
