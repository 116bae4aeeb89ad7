// Computes planes between pairs (method.md §5.6). A ball prevents a vertex from sliding along a neighbour and from
// leaving it; a half-space only prevents the approach. A pair has one normal n and two offsets o₁ < o₂: all vertices of
// its first side keep n·x ≤ o₁, all vertices of its second side n·x ≥ o₂. If the positions before and after a straight
// motion keep these inequalities, the convex hulls of both sides keep them at every instant between. So the pair cannot
// intersect. n may be any vector, if all vertices of the pair use the same bits.
#pragma once

#include "fast/kernels/arithmetic/solve3.hpp"
#include "fast/kernels/closest_face.hpp"
#include "fast/kernels/closest_points.hpp"
#include "fast/kernels/team.hpp"
#include "fast/kernels/truncate.hpp"

namespace ogc::fast {

/// Holds the plane of a pair, or only a lower bound of the pair's distance if there is no plane.
struct alignas(8) PairPlane {
  Vec normal;                    ///< from the first side to the second; 0: there is no plane
  float below = 0;               ///< lower bound of the pair's distance [m]
  double first = 0, second = 0;  ///< offsets o₁ < o₂ [m]

  /// Returns whether there is a plane. of_first() and of_second() return the half-spaces of the first and of the second
  /// side.
  OGC_HD bool exists() const { return normal.x != 0 || normal.y != 0 || normal.z != 0; }
  OGC_HD HalfSpace of_first() const { return {normal, first}; }
  OGC_HD HalfSpace of_second() const { return {-normal, -second}; }
};

/// Holds the points of both sides of a pair, and which sides are fixed.
template <int first_count, int second_count>
struct PairPoints {
  Vec first[first_count], second[second_count];  ///< by vertex of the side [m]
  bool is_first_fixed, is_second_fixed;
};

/// Returns the gap between the projections of both sides onto `direction` [m]. All points are relative to the same
/// origin.
template <int m, int n>
OGC_HD double shadow_gap(const Real& direction, const Real (&first)[m], const Real (&second)[n]) {
  double top = dot(direction, first[0]).value, bottom = dot(direction, second[0]).value;
  for (int k = 1; k < m; ++k) top = larger(top, dot(direction, first[k]).value);
  for (int k = 1; k < n; ++k) bottom = smaller(bottom, dot(direction, second[k]).value);
  return divide(sub(bottom, top), square_root(squared(direction)));
}

/// Replaces `best` by `direction` if `direction` has a larger gap between the sides' projections. In any direction this
/// gap is at most the distance of the two convex sides. It is equal to the distance in the direction that joins their
/// closest points. So the search for the largest gap finds this direction, without the faces that hold these points.
template <int m, int n>
OGC_HD void offer_direction(Real& best, double& best_gap, const Real& direction, const Real (&first)[m],
                            const Real (&second)[n]) {
  const double gap = shadow_gap(direction, first, second);
  if (!(gap > best_gap)) return;
  best = direction;
  best_gap = gap;
}

/// Returns the vector from the origin to the closest point of the segment from a to a + e.
OGC_HD inline Real to_segment(const Real& a, const Real& e) { return a + Rounded{segment_parameter(-a, e)} * e; }

/// Returns the direction from a vertex (first side) to the closest point of a triangle (second side); 0 if they touch.
OGC_HD inline Real separating_direction(const PairPoints<1, 3>& pair) {
  const Real first[1] = {};
  const Real second[3] = {difference<Rounded>(pair.second[0], pair.first[0]),
                          difference<Rounded>(pair.second[1], pair.first[0]),
                          difference<Rounded>(pair.second[2], pair.first[0])};
  Real best;
  double gap = 0;
  for (int k = 0; k < 3; ++k) {
    const Real e = difference<Rounded>(pair.second[(k + 1) % 3], pair.second[k]);
    offer_direction(best, gap, to_segment(second[k], e), first, second);
  }
  const Real n = cross(difference<Rounded>(pair.second[1], pair.second[0]),
                       difference<Rounded>(pair.second[2], pair.second[0]));
  offer_direction(best, gap, n, first, second);
  offer_direction(best, gap, -n, first, second);
  return best;
}

/// Returns the direction from the closest point of the first edge to the closest point of the second; 0 if they touch.
OGC_HD inline Real separating_direction(const PairPoints<2, 2>& pair) {
  const Real e = difference<Rounded>(pair.first[1], pair.first[0]),
             f = difference<Rounded>(pair.second[1], pair.second[0]),
             w = difference<Rounded>(pair.second[0], pair.first[0]);
  const Real first[2] = {Real{}, e}, second[2] = {w, difference<Rounded>(pair.second[1], pair.first[0])};
  Real best;
  double gap = 0;
  offer_direction(best, gap, to_segment(w, f), first, second);
  offer_direction(best, gap, to_segment(w - e, f), first, second);
  offer_direction(best, gap, -to_segment(-w, e), first, second);
  offer_direction(best, gap, -to_segment(-second[1], e), first, second);
  const Real n = cross(e, f);
  offer_direction(best, gap, n, first, second);
  offer_direction(best, gap, -n, first, second);
  return best;
}

/// Returns the distance of the two closed faces, with its slack.
OGC_HD inline Distance distance_of(const PairPoints<1, 3>& pair) {
  return point_triangle_distance(pair.first[0], {pair.second[0], pair.second[1], pair.second[2]});
}
OGC_HD inline Distance distance_of(const PairPoints<2, 2>& pair) {
  return edge_edge_distance({pair.first[0], pair.first[1]}, {pair.second[0], pair.second[1]});
}

/// Returns one half: each side may make half of the approach that the pair may make.
struct Halved {
  OGC_HD double operator()(const Vec&) const { return 0.5; }
};

/// Returns the first side's share of the approach that both sides may make together. Each side gets a share in
/// proportion to its speed along n (method.md §5.6, `bounds=dat`). The speed of the first side is the largest n·w among
/// the displacements w of its vertices, the speed of the second side the largest −n·w. A side that moves away has the
/// speed 0. The share is clamped to least_division … 1 − least_division.
template <int first_count, int second_count>
struct ByApproach {
  Vec first[first_count], second[second_count];  ///< w by vertex of the side [m]

  static constexpr double least_division = 0x1p-4;

  OGC_HD double operator()(const Vec& n) const {
    double a = 0, b = 0;
    for (const Vec& w : first) a = larger(a, excess(n, 0, w).value);
    for (const Vec& w : second) b = larger(b, -excess(n, 0, w).value);
    const double both = add(a, b);
    if (!(both > 0)) return 0.5;
    return smaller(1 - least_division, larger(least_division, divide(a, both)));
  }
};

/// Returns the plane of a pair at its positions. `share` is γ_p, `below` a lower bound of the pair's distance. Together
/// both sides may approach by 2γ_p of the gap; division(n) is the first side's share of this approach. If one side is
/// fixed, the other side has the whole approach. The fixed side's offset is then half way between the fixed side and
/// the other side's offset. Offsets are computed from the points themselves, so n need not be exact. All points must
/// pass the test that truncation uses; otherwise the pair has no plane.
template <int m, int n, class Division = Halved>
OGC_HD PairPlane plane_of(const PairPoints<m, n>& pair, float below, float share, const Division& division = {}) {
  PairPlane plane;
  plane.below = below;
  const Real direction = separating_direction(pair);
  const double length = square_root(squared(direction));
  if (!(length > 0)) return plane;
  const auto stored = [length](Rounded a) { return static_cast<float>(divide(a.value, length)); };
  const Vec normal{stored(direction.x), stored(direction.y), stored(direction.z)};
  double top = excess(normal, 0, pair.first[0]).value, bottom = excess(normal, 0, pair.second[0]).value;
  for (int k = 1; k < m; ++k) top = larger(top, excess(normal, 0, pair.first[k]).value);
  for (int k = 1; k < n; ++k) bottom = smaller(bottom, excess(normal, 0, pair.second[k]).value);
  const double gap = sub(bottom, top), own = static_cast<double>(share);
  const double both = add(own, own), part = division(normal);  // half of `both` is exactly γ_p
  const auto approach = [own, both](bool is_fixed, bool is_other_fixed, double own_part) {
    return is_fixed ? sub(0.5, own) : (is_other_fixed ? both : mul(both, own_part));
  };
  PairPlane placed{normal, below, add(top, mul(approach(pair.is_first_fixed, pair.is_second_fixed, part), gap)),
                   sub(bottom, mul(approach(pair.is_second_fixed, pair.is_first_fixed, sub(1, part)), gap))};
  bool separates = placed.first < placed.second;
  for (const Vec& x : pair.first) separates = separates && is_behind(placed.of_first(), x);
  for (const Vec& x : pair.second) separates = separates && is_behind(placed.of_second(), x);
  return separates ? placed : plane;
}

/// Returns the index ≥ `from` of the first half-space in which x does not certainly lie; region.count if there is none.
/// Team lanes share the tests, which would otherwise be the slowest part of an update.
template <class Lanes>
OGC_HD int first_left(const FeasibleRegion& region, const Vec& x, const Lanes& lanes, int from = 0) {
  return lanes.first(region.count, from, [&](int k) { return !is_behind(region.planes[k], x); });
}

/// Returns whether the stored x is certainly in the region.
template <class Lanes = OneLane>
OGC_HD bool is_within(const FeasibleRegion& region, const Vec& x, const Lanes& lanes = {}) {
  return first_left(region, x, lanes) == region.count && is_within(region.ball, x);
}

/// A metric returns, for the normal n of a half-space, the direction in which a vertex enters the half-space with the
/// least increase of its energy: H⁻¹ n. `prepared` does the work that does not depend on n.
struct BlockMetric {
  Symmetric3 block;    ///< H of the update, inertia included [N/m]
  float fallback = 0;  ///< as in solve_symmetric

  struct Prepared {
    Factors factors;
    float fallback;
    OGC_HD Vec operator()(const Vec& n) const { return solve(factors, n, fallback); }
  };
  OGC_HD Prepared prepared() const { return {factors_of(block), fallback}; }
};
/// The metric of inertia alone: H⁻¹ n is n, up to a factor.
struct InertiaMetric {
  OGC_HD Vec operator()(const Vec& n) const { return n; }
  OGC_HD InertiaMetric prepared() const { return *this; }
};

namespace slide {

using Point = Vector<double>;
inline constexpr int passes = 4, nudges = 3;  ///< at most: passes over the half-spaces, nudges of a stored position

/// Convert a point to double, which is exact, and back to single precision with one rounding.
OGC_HD inline Point wide(const Vec& a) { return {a.x, a.y, a.z}; }
OGC_HD inline Vec stored(const Point& a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

/// Returns how far y can move across the plane when it is stored in single precision and then nudged `steps` times.
/// Storing moves each coordinate by up to 2⁻²⁴ of itself. A nudge moves one coordinate to the next float, by up to 2⁻²³
/// of itself.
OGC_HD inline double room_to_store(const HalfSpace& plane, const Point& y, int steps) {
  const Point n = wide(plane.normal);
  return (1 + 2 * steps) * 0x1p-24 * (modulus(n.x * y.x) + modulus(n.y * y.y) + modulus(n.z * y.z));
}

/// Returns how far y lies beyond the plane, plus the largest distance across the plane that storing y may add. The
/// value only guides the search for a position; `is_within` decides whether the position is accepted.
OGC_HD inline double beyond(const HalfSpace& plane, const Point& y) {
  return dot(wide(plane.normal), y) - plane.offset + room_to_store(plane, y, 0);
}

/// Returns a radius such that a point within it remains in the ball when it is stored and nudged `steps` times. Storing
/// moves each coordinate by at most 2⁻²⁴ (‖X_prev‖_∞ + b), so the point by √3 times this. The code uses the factor 2
/// instead, because the arithmetic here is rounded, too.
OGC_HD inline double safe_radius(const FeasibleRegion& region, int steps = 0) {
  const Point centre = wide(region.ball.centre);
  const double radius = static_cast<double>(region.ball.radius);
  const double size = larger(larger(modulus(centre.x), modulus(centre.y)), modulus(centre.z)) + radius;
  return larger(0.0, radius - (2 + 2 * steps) * 0x1p-24 * size);
}

/// Moves y into the half-spaces that it violates, one after the other, then into the ball; repeats this up to `passes`
/// times.
template <class Metric, class Lanes>
OGC_HD Point along_planes(const FeasibleRegion& region, Point y, const Metric& metric, const Lanes& lanes) {
  const Point centre = wide(region.ball.centre);
  const auto direction = metric.prepared();
  for (int pass = 0; pass < passes; ++pass) {
    bool moved = false;
    const auto next = [&](int from) {
      return lanes.first(region.count, from, [&](int k) { return beyond(region.planes[k], y) > 0; });
    };
    for (int k = next(0); k < region.count; k = next(k + 1)) {
      const HalfSpace& plane = region.planes[k];
      const Point n = wide(plane.normal);
      Point u = wide(direction(plane.normal));
      if (!(dot(n, u) > 0)) u = n;
      y -= (beyond(plane, y) / dot(n, u)) * u;
      moved = true;
    }
    const Point away = y - centre;
    const double squares = dot(away, away), radius = safe_radius(region);
    // A root takes long. The factor covers the roundings of root and product, 3 · 2⁻⁵³ each side.
    if (squares > (1 - 0x1p-50) * radius * radius) {
      const double length = std::sqrt(squares);
      if (length > radius) y = centre + (radius / length) * away, moved = true;
    }
    if (!moved) break;
  }
  return y;
}

/// Moves one coordinate of x by one float into the first half-space that x violates, or into the ball. It chooses the
/// coordinate whose step moves x farthest inside, because floats near 0 are too close together. Let s_k be the spacing
/// of floats at coordinate k. Storing moves a point out of a half-space by at most Σ |n_k| s_k/2, so two nudges
/// suffice.
template <class Lanes>
OGC_HD Vec nudged(const FeasibleRegion& region, Vec x, const Lanes& lanes) {
  const int left = first_left(region, x, lanes);
  const Vec outward = left < region.count ? region.planes[left].normal : x - region.ball.centre;
  const auto inner = [](float c, float along) { return nextafterf(c, along > 0 ? -0x1p127f : 0x1p127f); };
  const Vec moved{inner(x.x, outward.x), inner(x.y, outward.y), inner(x.z, outward.z)};
  const float a = (x.x - moved.x) * outward.x, b = (x.y - moved.y) * outward.y, c = (x.z - moved.z) * outward.z;
  float& coordinate = a >= b && a >= c ? x.x : (b >= c ? x.y : x.z);
  coordinate = a >= b && a >= c ? moved.x : (b >= c ? moved.y : moved.z);
  return x;
}

/// A stored position.
struct Stored {
  Vec position;    ///< [m]
  bool is_inside;  ///< whether is_within holds
};

/// Returns y in single precision, nudged if it is outside of the region.
template <class Lanes>
OGC_HD Stored stored_inside(const FeasibleRegion& region, const Point& y, const Lanes& lanes) {
  Vec x = stored(y);
  for (int nudge = 0;; ++nudge) {
    if (is_within(region, x, lanes)) return {x, true};
    if (nudge == nudges) return {x, false};
    x = nudged(region, x, lanes);
  }
}

/// Returns the share of the straight path from `from` to y that lies in the region; `from` is in the region. The point
/// at this share stays in the region even after rounding to single precision and `steps` nudges.
template <class Lanes>
OGC_HD double share_inside(const FeasibleRegion& region, const Point& from, const Point& y, int steps,
                           const Lanes& lanes) {
  const Point step = y - from, away = from - wide(region.ball.centre);
  double share = lanes.smallest(region.count, 1, [&](int k) {
    const HalfSpace& plane = region.planes[k];
    const Point n = wide(plane.normal);
    const double room = larger(room_to_store(plane, from, steps), room_to_store(plane, y, steps)),
                 out = dot(n, y) - plane.offset + room, rise = dot(n, step);
    return out > 0 && rise > 0 ? larger(0.0, 1 - out / rise) : 1.0;
  });
  // Solves ‖away + s step‖ = radius for s. `from` may lie beyond this radius if the path first leads inward.
  const double radius = safe_radius(region, steps), bb = dot(step, step), ab = dot(away, step),
               left = radius * radius - dot(away, away), root = ab * ab + bb * left;
  if (bb > 0 && ab + ab + bb > left) share = smaller(share, root > 0 ? larger(0.0, (std::sqrt(root) - ab) / bb) : 0.0);
  return share;
}

/// Returns a stored position in the region, on the path from `from` to y: the farthest one, or one just before it.
/// Returns `from` if none is found. If two boundaries (of half-spaces or of the ball) cut the path at the same point, a
/// nudge into one may leave the other. Then the path is shortened and the nudges are repeated.
template <class Lanes>
OGC_HD Vec scaled(const FeasibleRegion& region, const Vec& from, const Point& y, const Lanes& lanes) {
  const Point start = wide(from);
  double share = share_inside(region, start, y, 0, lanes);
  for (int attempt = 0; attempt < 4 && share > 0; ++attempt) {
    const Stored x = stored_inside(region, start + share * (y - start), lanes);
    if (x.is_inside) return x.position;
    share = attempt == 0 ? share_inside(region, start, y, nudges, lanes) : 0.5 * share;
  }
  return from;
}

}  // namespace slide

/// Returns a position in the region, near a finite proposal outside of the region. The proposal slides along the
/// half-spaces, and is nudged if storing moved it out. If it is still outside, it is scaled towards `current`, which is
/// in the region. If this fails, the result is `current`.
template <class Metric, class Lanes>
OGC_HD OGC_OUT_OF_LINE Truncated slide_into(FeasibleRegion region, Vec current, Vec proposal, Metric metric,
                                            Lanes lanes) {
  const slide::Point y = slide::along_planes(region, slide::wide(proposal), metric, lanes);
  const slide::Stored x = slide::stored_inside(region, y, lanes);
  return {x.is_inside ? x.position : slide::scaled(region, current, y, lanes), true};
}

/// Truncates a proposal along the straight line from `current`. It is used for prescribed vertices, so that their
/// groups stay rigid, and for regions that do not slide.
template <class Lanes>
OGC_HD OGC_OUT_OF_LINE Truncated scale_into(FeasibleRegion region, Vec current, Vec proposal, Lanes lanes) {
  return {slide::scaled(region, current, slide::wide(proposal), lanes), true};
}

}  // namespace ogc::fast
