// Computes the exact update of a segment's quaternion, given its neighbours (compare/rods.md). The unknown is ν = μ −
// σ: with a stiff stretch, rounding of μ would lose the neighbours' part.
#pragma once

#include <cmath>

#include "fast/kernels/arithmetic/quaternion.hpp"

namespace ogc::fast {

/// A neighbour across one end.
struct NeighbourRest {
  float weight = 0;  ///< w = 4 k_b/l̄ [N m]; 0: no neighbour
  Quat rest;         ///< p° = q̄° q°_f for a neighbour ahead, q̄°_f q° for a neighbour behind
};

/// Returns the orientation t towards which a neighbour with quaternion `q` pulls, given the relative rotation p: q p̄
/// if it is ahead, q p if behind.
template <class T>
OGC_HD QuatOf<T> asked_orientation(bool is_ahead, const QuatOf<T>& q, const QuatOf<T>& relative) {
  return q * (is_ahead ? conjugate(relative) : relative);
}

/// Returns w s t with the sign s that brings t nearer to the old q.
template <class T>
OGC_HD QuatOf<T> pull_towards(const T& weight, const QuatOf<T>& asked, const QuatOf<T>& old) {
  return select(dot(asked, old) < T(0.0f), -weight, weight) * asked;
}

/// Adds w s t to b.
template <class T>
OGC_HD void add_undamped_neighbour(const T& weight, bool is_ahead, const QuatOf<T>& now, const QuatOf<T>& relative,
                                   const QuatOf<T>& old, QuatOf<T>& b) {
  const Mask<T> is_there = weight > T(0.0f);
  if (is_false(is_there)) return;
  b = select(is_there, b + pull_towards(weight, asked_orientation(is_ahead, now, relative), old), b);
}

/// Adds w (s t + k sᵗ tᵗ) to b. `now` and `start` are the neighbour's, `own_start` is the segment's.
OGC_HD inline void add_neighbour(const NeighbourRest& neighbour, bool is_ahead, float damping, const Quat& now,
                                 const Quat& start, const Quat& own_start, const Quat& old, Quat& b) {
  add_undamped_neighbour(neighbour.weight, is_ahead, now, neighbour.rest, old, b);
  if (!(neighbour.weight > 0 && damping > 0)) return;
  const Quat relative = is_ahead ? conjugate(own_start) * start : conjugate(start) * own_start;
  b = b + pull_towards(damping * neighbour.weight, asked_orientation(is_ahead, now, relative), old);
}

/// Returns the larger root ν of (β₊/ν)² + (β₋/(ν + 2σ))² = 1, β₊ > 0. Newton's method on 1/√(left side) rises to it
/// from below. Mostly it takes one step; up to twenty if β₋ is about 2 σ and β₊ vanishes.
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

/// Applies M/σ to q: −D q c with unit vectors, which is its own inverse.
template <class T>
struct ReflectedFrameOf {
  QuatOf<T> apart, direction;  ///< D/‖D‖, c/‖c‖

  OGC_HD QuatOf<T> operator()(const QuatOf<T>& q) const { return T(-1.0f) * (apart * q * direction); }
  /// Returns the part of q in the eigenspace of 1, whose directors are along D. It projects twice: after one projection
  /// a rounding error of the whole q is left outside, which would spoil a small part.
  OGC_HD QuatOf<T> upper(const QuatOf<T>& q) const {
    const QuatOf<T> once = T(0.5f) * (q + (*this)(q));
    return T(0.5f) * (once + (*this)(once));
  }
};
using ReflectedFrame = ReflectedFrameOf<float>;

/// Largest share of the whole that counts as rounding for the part in the upper eigenspace. Two products of quaternions
/// and half a sum err by 17 u (compare/stages/orientation.hpp); twice that leaves room.
inline constexpr float lost_part = 0x1p-19f;

/// Returns the unit vector of the upper eigenspace nearest to the old q; if the old q has no part in it, nearest to 1,
/// i or j. If 1 has none, c is antiparallel to D, and the eigenspace holds the pure quaternions across D.
OGC_HD inline Quat nearest_upper(const ReflectedFrame& frame, const Quat& old) {
  constexpr float lost = lost_part * lost_part;
  Quat part = frame.upper(old);
  if (!(dot(part, part) > lost)) part = frame.upper({0.0f, 0.0f, 0.0f, 1.0f});
  if (!(dot(part, part) > lost)) part = frame.upper({1.0f, 0.0f, 0.0f, 0.0f});
  if (!(dot(part, part) > lost)) part = frame.upper({0.0f, 1.0f, 0.0f, 0.0f});
  return unit(part);
}

/// Returns the minimiser of rod_orientation if `is_usual`: neighbours and stretch pull, and the neighbours do not pull
/// towards a reversed director.
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

/// Returns the minimiser of −½ qᵀMq − b·q on the unit sphere, M q = −2 k_s D q c; of several the one nearest to the old
/// q. `apart` is D [m], `direction` is c of rod_rest_direction.
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
  // the neighbours pull towards a reversed director
  const Quat lower = b - frame.upper(b);
  const float beta_lower = sqrtf(dot(lower, lower));
  if (beta_lower > 2.0f * sigma) return unit((1.0f / beta_lower) * lower);
  const float share = beta_lower / (2.0f * sigma), rest = 1.0f - share * share;
  return unit((0.5f / sigma) * lower + sqrtf(rest > 0 ? rest : 0.0f) * nearest_upper(frame, old));
}

}  // namespace ogc::fast
