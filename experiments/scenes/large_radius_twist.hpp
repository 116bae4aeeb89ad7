// Fig. 2: half a turn of a fine cloth with a contact radius as large as its edges, to compare contact models.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes; defaults: the paper's. The contact radius follows the spacing, so that every size has the regime of
/// r = 5 mm on 200 × 200: r is 0.995 edges.
struct LargeRadiusTwistSizes {
  compare::Index vertices_a_side = 200;  ///< of the cloth
  std::int64_t steps = 1200;             ///< a relative half turn in 4 s
};

/// Returns the scene: cloth and handles of twist, turned at ±π/8 rad/s. IPC's barrier distance is fixed at r.
compare::Scene large_radius_twist(const LargeRadiusTwistSizes& sizes = {});

}  // namespace ogc::experiments
