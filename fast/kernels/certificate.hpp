// Checks the motion certificate (method.md §5.5) on stored positions, in double.
#pragma once

#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/vector.hpp"
#include "fast/kernels/feasible_region.hpp"

namespace ogc::fast {

/// Returns whether ‖x − X_prev‖ > b_v. Differences of floats of similar size are exact in double; the squares have a
/// relative error of 2⁻⁵².
OGC_HD inline bool is_outside(const Ball& ball, const Vec& position) {
  const Vec& previous = ball.centre;
  const double x = static_cast<double>(position.x) - previous.x, y = static_cast<double>(position.y) - previous.y,
               z = static_cast<double>(position.z) - previous.z;
  return x * x + y * y + z * z > static_cast<double>(ball.radius) * ball.radius;
}

/// Returns whether the position fails the certificate: it is outside the ball, or not certainly within a half-space.
OGC_HD inline bool is_outside(const FeasibleRegion& region, const Vec& position) {
  bool outside = is_outside(region.ball, position);
  // without an early return, so that a device overlaps the loads of several half-spaces
  for (int k = 0; k < region.count; ++k) outside = !is_behind(region.planes[k], position) || outside;
  return outside;
}

}  // namespace ogc::fast
