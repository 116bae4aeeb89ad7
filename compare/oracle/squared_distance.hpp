// Computes squared distances of points, triangles and segments as quotients, so that no division is needed. If a
// feature (corner, edge or interior) may contain the closest point, its point, line or plane offers a squared distance.
// With exact numbers only the right features make offers; with intervals others may, too. The distance to a line or
// plane is at most the distance to a feature in it. So the least offer is the distance or, with intervals, a lower
// bound of the distance. Only .cpp files of compare/oracle include this header, since it exposes CGAL's number types.
#pragma once

#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>

#include <array>
#include <limits>

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Interval numbers; CGAL::Protect_FPU_rounding<true> must exist while they are used.
using Interval = CGAL::Interval_nt<false>;
using Exact = CGAL::Mpzf;

/// Return whether the number may have this sign. For an exact number: whether it has the sign. For an interval: whether
/// it contains a number with this sign.
inline bool may_be_positive(const Exact& x) { return static_cast<int>(x.sign()) > 0; }
inline bool may_be_negative(const Exact& x) { return static_cast<int>(x.sign()) < 0; }
inline bool may_be_zero_or_more(const Exact& x) { return static_cast<int>(x.sign()) >= 0; }
inline bool may_be_positive(const Interval& x) { return x.sup() > 0; }
inline bool may_be_negative(const Interval& x) { return x.inf() < 0; }
inline bool may_be_zero_or_more(const Interval& x) { return x.sup() >= 0; }

/// Keeps the least quotient exactly.
struct LeastSquare {
  Exact numerator{0}, denominator{0};  ///< denominator 0: nothing was offered yet
  /// Keeps n/d if it is less than the quotient so far; d > 0.
  void offer(const Exact& n, const Exact& d) {
    if (!denominator.is_zero() && !(n * denominator < numerator * d)) return;
    numerator = n;
    denominator = d;
  }
};

/// Keeps a lower bound of the least quotient.
struct SquareBelow {
  /// Lowers `value` to a lower bound of n/d, if `value` exceeds that bound. If d may be 0, the bound is 0.
  double value = std::numeric_limits<double>::infinity();
  /// Lowers the bound to a lower bound of n/d if the latter is less. The lower bound of n/d is 0 if d may be 0.
  void offer(const Interval& n, const Interval& d) { value = std::min(value, d.inf() > 0 ? (n / d).inf() : 0.0); }
};

/// A vector with coordinates of type N.
template <class N>
struct DistanceVector {
  N x, y, z;  ///< coordinates
};
/// minus, dot and cross return a − b, a·b and a × b; widen converts points to vectors over N.
template <class N>
DistanceVector<N> minus(const DistanceVector<N>& a, const DistanceVector<N>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class N>
N dot(const DistanceVector<N>& a, const DistanceVector<N>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class N>
DistanceVector<N> cross(const DistanceVector<N>& a, const DistanceVector<N>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class N, std::size_t K>
std::array<DistanceVector<N>, K> widen(const std::array<Vec3, K>& points) {
  std::array<DistanceVector<N>, K> wide;
  for (std::size_t k = 0; k < K; ++k) wide[k] = {N(points[k].x), N(points[k].y), N(points[k].z)};
  return wide;
}

/// Offers the squared distance of a point and the closed segment ab, which may be a point.
template <class N, class Least>
void offer_point_segment(const DistanceVector<N>& p, const DistanceVector<N>& a, const DistanceVector<N>& b,
                         Least& least) {
  const auto e = minus(b, a), w = minus(p, a), rest = minus(p, b);
  const N length = dot(e, e), along = dot(w, e), beyond = along - length;
  if (!may_be_positive(along) || may_be_negative(along)) least.offer(dot(w, w), N(1));
  if (may_be_zero_or_more(beyond)) least.offer(dot(rest, rest), N(1));
  if (!may_be_positive(along) || !may_be_negative(beyond)) return;
  const auto area = cross(e, w);
  least.offer(dot(area, area), length);
}

/// Offers the squared distance of a point and a closed triangle, which may be collapsed.
template <class N, class Least>
void offer_distance(const std::array<DistanceVector<N>, 1>& point, const std::array<DistanceVector<N>, 3>& corners,
                    Least& least) {
  const auto n = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
  const N square = dot(n, n);
  bool possible = may_be_positive(square), certain = possible;
  for (std::size_t k = 0; k < 3 && possible; ++k) {
    const N inward = dot(cross(minus(corners[(k + 1) % 3], corners[k]), minus(point[0], corners[k])), n);
    possible = may_be_zero_or_more(inward);
    certain = certain && !may_be_negative(inward);
  }
  if (possible) {
    const N height = dot(n, minus(point[0], corners[0]));
    least.offer(height * height, square);
    if (certain) return;
  }
  for (std::size_t k = 0; k < 3; ++k) offer_point_segment(point[0], corners[k], corners[(k + 1) % 3], least);
}

/// Offers the squared distance of two closed segments; a segment may be a point.
template <class N, class Least>
void offer_distance(const std::array<DistanceVector<N>, 2>& first, const std::array<DistanceVector<N>, 2>& second,
                    Least& least) {
  const auto u = minus(first[1], first[0]), v = minus(second[1], second[0]), w = minus(second[0], first[0]),
             n = cross(u, v);
  const N square = dot(n, n), s = dot(cross(w, v), n), t = dot(cross(w, u), n);
  const N s_rest = square - s, t_rest = square - t;
  bool possible = may_be_positive(square), certain = possible;
  for (const N* inward : {&s, &t, &s_rest, &t_rest}) {
    possible = possible && may_be_zero_or_more(*inward);
    certain = certain && !may_be_negative(*inward);
  }
  if (possible) {
    const N height = dot(n, w);
    least.offer(height * height, square);
    if (certain) return;
  }
  for (const auto& end : first) offer_point_segment(end, second[0], second[1], least);
  for (const auto& end : second) offer_point_segment(end, first[0], first[1], least);
}

}  // namespace ogc::compare
