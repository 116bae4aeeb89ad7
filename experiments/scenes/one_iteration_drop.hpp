// Fig. 20: a square cloth falls onto a small sphere, with one iteration a step.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes; defaults: the paper's; a frame is 10 steps. The contact radius follows the spacing: 5 mm on 70 ×
/// 70.
struct OneIterationDropSizes {
  compare::Index vertices_a_side = 70;  ///< of the cloth
  int sphere_subdivisions = 3;          ///< of an icosahedron
  std::int64_t steps = 800;             ///< of the run
};

/// Returns the scene: 1 m × 1 m of cloth at y = 0.30 m above a sphere of radius 0.10 m about (−0.15, 0, 0). A step is
/// one sweep of OGC or one iteration of IPC, neither to a tolerance.
compare::Scene one_iteration_drop(const OneIterationDropSizes& sizes = {});

}  // namespace ogc::experiments
