// Fig. 2: a fine cloth, whose contact radius is as large as its edges, is twisted by 180° to compare contact models.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes; defaults: the paper's. The contact radius is always 0.995 edges: 5 mm on 200 × 200.
struct LargeRadiusTwistSizes {
  compare::Index vertices_a_side = 200;  ///< along each side of the cloth
  std::int64_t steps = 1200;             ///< 4 s, in which one end rotates by 180° relative to the other
};

/// Returns the scene: the cloth and handles of the scene twist; the handles rotate at ±π/8 rad/s. IPC's barrier
/// distance is r.
compare::Scene large_radius_twist(const LargeRadiusTwistSizes& sizes = {});

}  // namespace ogc::experiments
