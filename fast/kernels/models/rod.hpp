// Adds the stretch and shear of a segment as one of its ends sees it: k_s l/2 ‖D/l − R(q) e₃‖² (compare/rods.md).
#pragma once

#include "fast/kernels/arithmetic/accumulator.hpp"
#include "fast/kernels/arithmetic/quaternion.hpp"

namespace ogc::fast {

/// A segment at rest.
struct SegmentRest {
  int end[2] = {-1, -1};           ///< x₀, x₁
  float length = 0;                ///< l [m]
  float stretch = 0, damping = 0;  ///< k_s [N], k_d/h [1]
};

/// Returns c = e₃ + k R(qᵗ)ᵀ Dᵗ/l, the direction of zero force: a segment has no force if (1 + k) D/l = R(q) c. `apart`
/// is Dᵗ [m], `damping` is k = k_d/h.
OGC_HD inline Vec rod_rest_direction(const SegmentRest& segment, float damping, const Quat& start, const Vec& apart) {
  const Vec axis{0.0f, 0.0f, 1.0f};
  return damping > 0 ? axis + (damping / segment.length) * turned_back(start, apart) : axis;
}

/// Adds the force and block of an end (0 or 1). `apart` is D [m]; `direction` is c of rod_rest_direction with the same
/// damping.
OGC_HD inline void add_rod(const SegmentRest& segment, float damping, int end, const Vec& apart, const Quat& q,
                           const Vec& direction, ForceAndBlock& sum) {
  const float over_length = (1.0f + damping) / segment.length;
  const Vec strain = over_length * apart - turned(q, direction);
  sum.add_force(end == 0 ? segment.stretch : -segment.stretch, strain);
  sum.add_identity(segment.stretch * over_length);
}

}  // namespace ogc::fast
