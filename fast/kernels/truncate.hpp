// Truncation to the conservative bound (Eq. 27, 28) so that the position that is *stored* obeys it: the cut is made in double, each coordinate rounded
// towards x_prev, and the stored result tested exactly.
#pragma once

#include "fast/kernels/predicates.hpp"

namespace ogc::fast {

struct Truncated {
  Vec position;
  bool exceeded = false;
};

/// ‖x − x_prev‖ ≤ b, decided on the stored single-precision numbers without error. False where x is not finite.
OGC_HD inline bool is_within_bound(const Vec& previous, const Vec& x, float bound) {
  const PointReach reach{x, previous, bound};
  const Filtered margin = reach.value<Filtered>();
  if (!(margin.scale < 0x1p1000)) return false;
  const Sign sign = margin.sign();
  return (sign.certain ? sign.value : reach.value<Wide>().sign().value) <= 0;
}

/// The float nearest to p + s (x − p) that is no farther from p.
OGC_HD inline float towards(float p, float x, double s) {
  const double step = mul(s, sub(static_cast<double>(x), static_cast<double>(p))), place = add(static_cast<double>(p), step);
  return step > 0 ? round_down(place) : round_up(place);
}

/// x where it is within the bound, bit for bit; otherwise the point of the segment from x_prev at distance b, or just short of it. x_prev where x is
/// not finite.
OGC_HD inline Truncated truncate(const Vec& previous, const Vec& x, float bound) {
  if (is_within_bound(previous, x, bound)) return {x, false};
  const Vector<Rounded> step = difference<Rounded>(x, previous);
  double s = divide(static_cast<double>(bound), square_root(dot(step, step).value));
  // The second and third tries are for a step whose rounding in double crossed a float, with coordinates far larger than the bound.
  for (int attempt = 0; attempt < 3; ++attempt) {
    const Vec cut{towards(previous.x, x.x, s), towards(previous.y, x.y, s), towards(previous.z, x.z, s)};
    if (is_within_bound(previous, cut, bound)) return {cut, true};
    s = mul(s, 1 - 0x1p-22);
  }
  return {previous, true};
}

}  // namespace ogc::fast
