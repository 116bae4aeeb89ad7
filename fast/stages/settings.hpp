// What a user can set of the fast path alone.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::fast {

/// Largest margin of the pairs that detections of a simulation keep and look at again (fast/stages/skin.hpp), as a
/// share of r; 0: each searches. It changes the time alone. Throws compare::InputError where the trees are needed at
/// each detection.
float skin_share(const compare::Scene& scene);

}  // namespace ogc::fast
