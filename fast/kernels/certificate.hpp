// The motion certificate (method.md §5.5): on stored positions, in double.
#pragma once

#include "fast/kernels/plane_lists.hpp"
#include "fast/kernels/qualifiers.hpp"
#include "fast/kernels/vector.hpp"

namespace ogc::fast {

/// ‖x − X_prev‖ > b_v. Differences of single-precision numbers of one size are exact in double; the squares leave 2⁻⁵²
/// of b².
OGC_HD inline bool bound_violated(const Vec& position, const Vec& previous, float bound) {
  const double x = static_cast<double>(position.x) - previous.x, y = static_cast<double>(position.y) - previous.y,
               z = static_cast<double>(position.z) - previous.z;
  return x * x + y * y + z * z > static_cast<double>(bound) * bound;
}

/// Not in the region for certain: beyond the ball, or a half-space that the test of stored positions refuses.
OGC_HD inline bool is_outside(const FeasibleRegion& region, const Vec& position) {
  for (int k = 0; k < region.count; ++k)
    if (!is_behind(region.planes[k], position)) return true;
  return bound_violated(position, region.centre, region.radius);
}

}  // namespace ogc::fast
