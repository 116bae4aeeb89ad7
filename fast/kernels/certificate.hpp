// The motion certificate (method.md §5.5): on stored positions, in double.
#pragma once

#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/vector.hpp"
#include "fast/kernels/feasible_region.hpp"

namespace ogc::fast {

/// ‖x − X_prev‖ > b_v. Differences of single-precision numbers of one size are exact in double; the squares leave 2⁻⁵²
/// of b².
OGC_HD inline bool is_outside(const FeasibleRegion& region, const Vec& position) {
  const Vec& previous = region.centre;
  const double x = static_cast<double>(position.x) - previous.x, y = static_cast<double>(position.y) - previous.y,
               z = static_cast<double>(position.z) - previous.z;
  return x * x + y * y + z * z > static_cast<double>(region.radius) * region.radius;
}

}  // namespace ogc::fast
