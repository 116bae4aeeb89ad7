// Fig. 20: a square cloth falls onto a small sphere, with one iteration in each step.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes; the defaults are the paper's. A frame is 10 steps. The contact radius is proportional to the
/// spacing: 5 mm for a cloth of 70 × 70 vertices.
struct OneIterationDropSizes {
  compare::Index vertices_a_side = 70;  ///< along each side of the cloth
  int sphere_subdivisions = 3;          ///< divisions of an icosahedron's triangles into four
  std::int64_t steps = 800;             ///< steps of the run
};

/// Returns the scene: a cloth of 1 m × 1 m at y = 0.30 m above a sphere of radius 0.10 m about (−0.15, 0, 0). A step is
/// one sweep of OGC or one iteration of IPC; no tolerance applies.
compare::Scene one_iteration_drop(const OneIterationDropSizes& sizes = {});

}  // namespace ogc::experiments
