// Computes, for a segment, the quaternion that minimises the energy, given the neighbours' quaternions
// (compare/rods.md, The stage `orientation`, defines M, b, μ and σ). The unknown is ν = μ − σ. For a stiff stretch μ is
// so large that rounding would lose the contribution of the neighbours.
#pragma once

#include <cmath>

#include "fast/kernels/arithmetic/quaternion.hpp"

namespace ogc::fast {

/// The neighbour at one end of a segment.
struct NeighbourRest {
  float weight = 0;  ///< w = 4 k_b/l̄ [N m]; 0: no neighbour
  /// relative rotation at rest: p° = q̄° q°_f if neighbour f follows the segment, q̄°_f q° if it precedes it
  Quat rest;
};

/// Returns the quaternion t that gives a segment the relative rotation p = `relative` to a neighbour with quaternion
/// `q`: q p̄ if the neighbour follows the segment, q p if it precedes the segment. p̄ is the conjugate of p.
template <class T>
OGC_HD QuatOf<T> asked_orientation(bool is_ahead, const QuatOf<T>& q, const QuatOf<T>& relative) {
  return q * (is_ahead ? conjugate(relative) : relative);
}

/// Returns w t or −w t, with w = `weight` and t = `asked`. The sign makes the product of t and `old` non-negative.
template <class T>
OGC_HD QuatOf<T> pull_towards(const T& weight, const QuatOf<T>& asked, const QuatOf<T>& old) {
  return select(dot(asked, old) < T(0.0f), -weight, weight) * asked;
}

/// Adds the elastic pull of a neighbour (pull_towards) to b, the linear term of the energy.
template <class T>
OGC_HD void add_undamped_neighbour(const T& weight, bool is_ahead, const QuatOf<T>& now, const QuatOf<T>& relative,
                                   const QuatOf<T>& old, QuatOf<T>& b) {
  const Mask<T> is_there = weight > T(0.0f);
  if (is_false(is_there)) return;
  b = select(is_there, b + pull_towards(weight, asked_orientation(is_ahead, now, relative), old), b);
}

/// Adds the elastic and the damping pull of a neighbour to b. The damping pull has k times the neighbour's weight (k =
/// `damping`), and the relative rotation at the start of the step instead of the relative rotation at rest. `now` and
/// `start` are the neighbour's quaternions, `own_start` is qᵗ of the segment.
OGC_HD inline void add_neighbour(const NeighbourRest& neighbour, bool is_ahead, float damping, const Quat& now,
                                 const Quat& start, const Quat& own_start, const Quat& old, Quat& b) {
  add_undamped_neighbour(neighbour.weight, is_ahead, now, neighbour.rest, old, b);
  if (!(neighbour.weight > 0 && damping > 0)) return;
  const Quat relative = is_ahead ? conjugate(own_start) * start : conjugate(start) * own_start;
  b = b + pull_towards(damping * neighbour.weight, asked_orientation(is_ahead, now, relative), old);
}

/// Returns the larger root ν of (β₊/ν)² + (β₋/(ν + 2σ))² = 1. β₊ = `upper` > 0 and β₋ = `lower` are the norms of the
/// parts of b in the eigenspaces of M/σ with eigenvalue 1 and −1. Newton's method on 1/√(left side) converges from
/// below. It usually needs one step, and up to twenty if β₋ is about 2σ and β₊ is nearly 0.
template <class T>
OGC_HD T secular_root(const T& upper, const T& lower, const T& sigma) {
  constexpr int most_steps = 32;
  constexpr float enough = 0x3p-23f;  // rounding error of the left side
  const T twice = 2.0f * sigma;
  T nu = select(upper > lower - twice, upper, lower - twice);
  for (int step = 0; step < most_steps; ++step) {
    const T from_upper = upper / nu, from_lower = lower / (nu + twice);
    const T squared = from_upper * from_upper + from_lower * from_lower, beyond = root(squared) - 1.0f;
    const Mask<T> goes_on = beyond > T(enough);
    if (is_false(goes_on)) break;
    nu = select(goes_on,
                nu + squared * beyond / (from_upper * from_upper / nu + from_lower * from_lower / (nu + twice)), nu);
  }
  return nu;
}

/// Computes M q/σ = −D q c for unit vectors D and c (compare/rods.md). This map is its own inverse.
template <class T>
struct ReflectedFrameOf {
  /// Returns the projection of q onto the eigenspace of eigenvalue 1, where directors are along D. It projects twice:
  /// after one projection, the rounding error outside the eigenspace is relative to ‖q‖, and could exceed the
  /// projection itself.
  QuatOf<T> apart, direction;

  OGC_HD QuatOf<T> operator()(const QuatOf<T>& q) const { return T(-1.0f) * (apart * q * direction); }
  /// Returns the part of q in the eigenspace of eigenvalue 1, whose directors are along D. It projects twice. After
  /// only one projection, the rounding error outside the eigenspace is relative to ‖q‖, and could exceed the projection
  /// itself.
  OGC_HD QuatOf<T> upper(const QuatOf<T>& q) const {
    const QuatOf<T> once = T(0.5f) * (q + (*this)(q));
    return T(0.5f) * (once + (*this)(once));
  }
};
using ReflectedFrame = ReflectedFrameOf<float>;

/// Largest ‖P₊b‖/‖b‖ that counts as rounding error; P₊b is the part of b in the eigenspace of M/σ with eigenvalue 1.
/// Two products of quaternions and half a sum err by 17 · 2⁻²⁴ (compare/stages/orientation.hpp); the limit is about
/// twice as much.
inline constexpr float lost_part = 0x1p-19f;

/// Returns the unit vector of the eigenspace of eigenvalue 1 that is nearest to the old q. If the old q is
/// perpendicular to this space, it is replaced by the first of the quaternions 1, i and j that is not perpendicular to
/// the space.
OGC_HD inline Quat nearest_upper(const ReflectedFrame& frame, const Quat& old) {
  constexpr float lost = lost_part * lost_part;
  Quat part = frame.upper(old);
  if (!(dot(part, part) > lost)) part = frame.upper({0.0f, 0.0f, 0.0f, 1.0f});
  if (!(dot(part, part) > lost)) part = frame.upper({1.0f, 0.0f, 0.0f, 0.0f});
  if (!(dot(part, part) > lost)) part = frame.upper({0.0f, 1.0f, 0.0f, 0.0f});
  return unit(part);
}

/// Returns the minimiser of rod_orientation in the usual case. Sets `is_usual` to whether this case holds: σ > 0, b is
/// not 0, and P₊b (see lost_part) is not only rounding error.
template <class T>
OGC_HD QuatOf<T> usual_orientation(const T& stretch, const Vector<T>& apart, const Vector<T>& direction,
                                   const QuatOf<T>& b, Mask<T>& is_usual) {
  const T length = root(dot(apart, apart)), size = root(dot(direction, direction));
  const T sigma = 2.0f * stretch * length * size, pull = root(dot(b, b));
  const ReflectedFrameOf<T> frame{pure(T(1.0f / length) * apart), pure(T(1.0f / size) * direction)};
  const QuatOf<T> upper = frame.upper(b), lower = b - upper;
  const T beta_upper = root(dot(upper, upper)), beta_lower = root(dot(lower, lower));
  is_usual = sigma > T(0.0f) && pull > T(0.0f) && beta_upper > lost_part * pull;
  const T nu = secular_root(beta_upper, beta_lower, sigma);
  return unit(T(1.0f / nu) * upper + T(1.0f / (nu + 2.0f * sigma)) * lower);
}

/// Returns the minimiser q of −½ qᵀMq − b·q on the unit sphere, with M q = −2 k_s D q c. If there are several, returns
/// the one nearest to the old q. `apart` is D [m]; `direction` is c of rod_rest_direction.
OGC_HD inline Quat rod_orientation(float stretch, const Vec& apart, const Vec& direction, const Quat& b,
                                   const Quat& old) {
  bool is_usual = false;
  const Quat usual = usual_orientation(stretch, apart, direction, b, is_usual);
  if (is_usual) return usual;
  const float length = sqrtf(dot(apart, apart)), size = sqrtf(dot(direction, direction));
  const float sigma = 2.0f * stretch * length * size, pull = sqrtf(dot(b, b));
  if (!(sigma > 0)) return pull > 0 ? unit((1.0f / pull) * b) : old;
  const ReflectedFrame frame{pure((1.0f / length) * apart), pure((1.0f / size) * direction)};
  if (!(pull > 0)) return nearest_upper(frame, old);
  // b has no part in the eigenspace of eigenvalue 1: the neighbours pull the director towards −D
  const Quat lower = b - frame.upper(b);
  const float beta_lower = sqrtf(dot(lower, lower));
  if (beta_lower > 2.0f * sigma) return unit((1.0f / beta_lower) * lower);
  const float share = beta_lower / (2.0f * sigma), rest = 1.0f - share * share;
  return unit((0.5f / sigma) * lower + sqrtf(rest > 0 ? rest : 0.0f) * nearest_upper(frame, old));
}

}  // namespace ogc::fast
