// How far all vertices may go along a direction, the same share of it for all, before the first pair meets.
#pragma once

#include <optional>

#include "reference/ipc/pairs.hpp"

namespace ogc::reference {

/// How far a move may go.
struct StepBound {
  double share = 1;                   ///< of the direction, in [0, 1]; on the way no pair comes to `thickness`
  std::optional<PrimitivePair> pair;  ///< which stops it first, where one does
};

/// Additive CCD of each pair from x along `direction` [m]; the smallest time, `until` where none is smaller. Threads
/// change nothing.
StepBound step_bound(const PairMesh& mesh, const std::vector<PrimitivePair>& pairs, const State& x,
                     const State& direction, double thickness, double until = 1);

/// ‖p_v‖ of the fastest vertex [m].
double largest_motion(const State& direction);

}  // namespace ogc::reference
