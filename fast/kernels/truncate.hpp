// Truncates to the conservative bound (Eq. 27, 28) so that the *stored* position is within it. The cut is computed in
// double, each coordinate is rounded towards x_prev, and the stored result is tested exactly.
#pragma once

#include "fast/kernels/arithmetic/vector.hpp"
#include "fast/kernels/feasible_region.hpp"
#include "fast/kernels/predicates.hpp"

namespace ogc::fast {

/// Holds a position inside its region, and whether truncation changed the proposal.
struct Truncated {
  Vec position;  ///< [m]
  bool cut = false;
};

/// Returns whether single precision proves ‖x − x_prev‖ < b. With u = 2⁻²⁴ a difference errs by u, so the sum of three
/// squares is at least (1 − u)⁵ of the exact one. b² (1 − 16 u), rounded twice, is at most (1 + u)² (1 − 16 u) b² < (1
/// − u)⁵ b². Squares that underflow err by 2⁻¹⁵⁰ each, far less than 16 u b² if b² ≥ 2⁻¹⁰⁰. Contraction only omits
/// roundings, so the proof remains valid. Returns false if x is not finite.
OGC_HD inline bool is_certainly_within(const Ball& ball, const Vec& x) {
  const Vec step = x - ball.centre;
  const float squared = ball.radius * ball.radius;
  return squared >= 0x1p-100f && squared <= 0x1p100f && dot(step, step) < (1.0f - 16 * 0x1p-24f) * squared;
}

/// Holds a sum of doubles without rounding, as several doubles that do not overlap, in ascending order of size
/// (Shewchuk's expansions).
struct ExactTotal {
  double part[8] = {};  ///< in use: the first `count`
  int count = 0;        ///< at most 8, because there are four squares and each adds two

  /// Adds a number without rounding.
  OGC_HD void grow(double value) {
    for (int i = 0; i < count; ++i) {
      const double s = add(value, part[i]), v = sub(s, value);
      part[i] = add(sub(value, sub(s, v)), sub(part[i], v));
      value = s;
    }
    part[count++] = value;
  }
  /// Adds ±a².
  OGC_HD void grow_square(double a, double sign) {
    const double p = mul(a, a), rest = fused(a, a, -p);
    grow(sign * p), grow(sign * rest);
  }
  /// Returns whether the sum is positive: it has the sign of its largest component that is not 0.
  OGC_HD bool is_positive() const {
    for (int i = count - 1; i >= 0; --i)
      if (part[i] != 0) return part[i] > 0;
    return false;
  }
};

/// Returns whether ‖x − x_prev‖ ≤ b, without rounding. It is called if double-double cannot distinguish the distance
/// from b: at a tie, or if x is barely outside, for example if one coordinate differs by b and another by 10⁻²¹.
/// Returns false if a difference of coordinates does not fit into a double.
OGC_HD inline bool is_exactly_within(const Ball& ball, const Vec& x) {
  const Vector<Wide> step = difference<Wide>(x, ball.centre);
  if (step.x.low != 0 || step.y.low != 0 || step.z.low != 0) return false;
  ExactTotal margin;
  margin.grow_square(step.x.high, 1), margin.grow_square(step.y.high, 1), margin.grow_square(step.z.high, 1);
  margin.grow_square(static_cast<double>(ball.radius), -1);
  return !margin.is_positive();
}

/// Returns whether ‖x − x_prev‖ ≤ b, decided exactly on the stored single-precision numbers. False if x is not finite.
OGC_HD inline bool is_within(const Ball& ball, const Vec& x) {
  if (is_certainly_within(ball, x)) return true;
  const PointReach reach{x, ball.centre, ball.radius};
  const Filtered margin = reach.value<Filtered>();
  if (!(margin.scale < 0x1p1000)) return false;
  const Sign quick = margin.sign();
  if (quick.certain) return quick.value <= 0;
  const int sign = reach.value<Wide>().sign().value;
  return sign < 0 || (sign == 0 && is_exactly_within(ball, x));
}

/// Returns p + s (x − p), rounded towards p to a float.
OGC_HD inline float towards(float p, float x, double s) {
  const double step = mul(s, sub(static_cast<double>(x), static_cast<double>(p))),
               place = add(static_cast<double>(p), step);
  return step > 0 ? round_down(place) : round_up(place);
}

/// Does the work of `truncate` if single precision does not prove that x is within the bound.
OGC_HD OGC_OUT_OF_LINE inline Truncated truncate_in_double(Ball ball, Vec x) {
  if (is_within(ball, x)) return {x, false};
  const Vec& previous = ball.centre;
  const Vector<Rounded> step = difference<Rounded>(x, previous);
  double s = divide(static_cast<double>(ball.radius), square_root(dot(step, step).value));
  // The first attempt fails only if rounding of the step in double leaves the point outside the ball. This is rare:
  // coordinates must be far larger than the bound, or the step nearly parallel to an axis.
  for (int attempt = 0; attempt < 3; ++attempt) {
    const Vec cut{towards(previous.x, x.x, s), towards(previous.y, x.y, s), towards(previous.z, x.z, s)};
    if (is_within(ball, cut)) return {cut, true};
    s = mul(s, 1 - 0x1p-22);
  }
  return {previous, true};
}

/// Returns x, bit for bit, if the ball holds it. Otherwise returns the point at distance b from x_prev on the segment
/// to x, or just before it. Returns x_prev if x is not finite.
OGC_HD inline Truncated truncate(const Ball& ball, const Vec& x) {
  if (is_certainly_within(ball, x)) return {x, false};
  return truncate_in_double(ball, x);
}

}  // namespace ogc::fast
