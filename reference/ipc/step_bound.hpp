// How far all vertices may move along a direction, by a common share of it, before the first pair meets.
#pragma once

#include <optional>

#include "reference/ipc/pairs.hpp"

namespace ogc::reference {

/// How far a move may go.
struct StepBound {
  double share = 1;                   ///< of the direction, in [0, 1]; on the way no pair comes as near as `thickness`
  std::optional<PrimitivePair> pair;  ///< the pair that stops it first, if any
};

/// Does additive CCD of each pair from x along `direction` [m] and returns the smallest time, `until` where none is
/// smaller. Threads change nothing.
StepBound step_bound(const PairMesh& mesh, const std::vector<PrimitivePair>& pairs, const State& x,
                     const State& direction, double thickness, double until = 1);

/// Returns ‖p_v‖ of the fastest vertex [m].
double largest_motion(const State& direction);

}  // namespace ogc::reference
