// Planes between pairs (method.md §5.6): where a ball takes from a vertex the freedom to slide along a neighbour and to
// leave it, a half-space takes the approach alone. A pair has one normal n and two offsets: all vertices of its first
// side keep n·x ≤ o₁, all of its second n·x ≥ o₂, with o₁ < o₂. So do the convex hulls of both sides, at every instant
// of a straight motion between two positions that keep it: the pair cannot meet. n may be any vector, as long as all
// vertices of the pair read the same bits.
#pragma once

#include "fast/kernels/arithmetic/solve3.hpp"
#include "fast/kernels/closest_face.hpp"
#include "fast/kernels/closest_points.hpp"
#include "fast/kernels/team.hpp"
#include "fast/kernels/truncate.hpp"

namespace ogc::fast {

/// The plane of a pair, or the smallest distance that is known of one that has none.
struct alignas(8) PairPlane {
  Vec normal;                    ///< from the first side to the second; 0: there is no plane
  float below = 0;               ///< not above the pair's distance [m]
  double first = 0, second = 0;  ///< offsets o₁ < o₂ [m]

  /// Whether there is a plane; where there is, the half-spaces that vertices of either side keep.
  OGC_HD bool exists() const { return normal.x != 0 || normal.y != 0 || normal.z != 0; }
  OGC_HD HalfSpace of_first() const { return {normal, first}; }
  OGC_HD HalfSpace of_second() const { return {-normal, -second}; }
};

/// The points of both sides of a pair, and which sides do not move.
template <int first_count, int second_count>
struct PairPoints {
  Vec first[first_count], second[second_count];  ///< by vertex of the side [m]
  bool is_first_fixed, is_second_fixed;
};

/// Returns the gap between the shadows of both sides on `direction`, divided by its length. Points are relative to one
/// of them.
template <int m, int n>
OGC_HD double shadow_gap(const Real& direction, const Real (&first)[m], const Real (&second)[n]) {
  double top = dot(direction, first[0]).value, bottom = dot(direction, second[0]).value;
  for (int k = 1; k < m; ++k) top = larger(top, dot(direction, first[k]).value);
  for (int k = 1; k < n; ++k) bottom = smaller(bottom, dot(direction, second[k]).value);
  return divide(sub(bottom, top), square_root(squared(direction)));
}

/// Keeps the better of two directions. Two convex sets are no nearer than the gap of their shadows, and along the line
/// of their closest points that gap is their distance. So it is not necessary to know which faces hold these points.
template <int m, int n>
OGC_HD void offer_direction(Real& best, double& best_gap, const Real& direction, const Real (&first)[m],
                            const Real (&second)[n]) {
  const double gap = shadow_gap(direction, first, second);
  if (!(gap > best_gap)) return;
  best = direction;
  best_gap = gap;
}

/// Returns the vector from the origin, where the point lies, to the segment from a along e.
OGC_HD inline Real to_segment(const Real& a, const Real& e) { return a + Rounded{segment_parameter(-a, e)} * e; }

/// Returns the direction from the closest point of the first side, a vertex, to that of the second, a triangle; 0 where
/// they touch.
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

/// Returns the same direction for two edges.
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

/// Returns the distance of the closed faces, with its slack, and nothing else: no exact sign decides which faces hold
/// the closest points.
OGC_HD inline Distance distance_of(const PairPoints<1, 3>& pair) {
  return point_triangle_distance(pair.first[0], {pair.second[0], pair.second[1], pair.second[2]});
}
OGC_HD inline Distance distance_of(const PairPoints<2, 2>& pair) {
  return edge_edge_distance({pair.first[0], pair.first[1]}, {pair.second[0], pair.second[1]});
}

/// The first side's share of 2γ_p of the gap where both can move: one half.
struct Halved {
  OGC_HD double operator()(const Vec&) const { return 0.5; }
};

/// The same in proportion to how fast the sides approach along n (method.md §5.6, dat): the largest n·w of the first
/// over its sum with the largest −n·w of the second, what leaves being slow. Within least_division of 0 and 1.
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

/// The plane of a pair at its positions, which is not nearer than `below`, with γ_p = `share`: both sides together may
/// approach by 2γ_p of the gap, of which the first has division(n); where a side is fixed the other has all. Offsets
/// are taken from the points themselves, so n need not be exact; whether every point keeps its own is tested as it will
/// be tested later, and a pair that fails has no plane. A fixed side has its offset half way from it to the other's.
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
  const double both = add(own, own), part = division(normal);  // of two halves each is γ_p, to the bit
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

/// The first half-space from number `from` on that x does not keep for certain; region.count where there is none. Team
/// lanes share them out: one after the other they are the longest chain of a colour.
template <class Lanes>
OGC_HD int first_left(const FeasibleRegion& region, const Vec& x, const Lanes& lanes, int from = 0) {
  return lanes.first(region.count, from, [&](int k) { return !is_behind(region.planes[k], x); });
}

/// Checks whether x is in the region for certain; decides on the stored numbers.
template <class Lanes = OneLane>
OGC_HD bool is_within(const FeasibleRegion& region, const Vec& x, const Lanes& lanes = {}) {
  return first_left(region, x, lanes) == region.count && is_within(region.ball, x);
}

/// The direction in which a vertex leaves a half-space with the least increase of its energy: H⁻¹ n.
struct BlockMetric {
  Symmetric3 block;    ///< H of the update, inertia included [N/m]
  float fallback = 0;  ///< as of solve_symmetric

  OGC_HD Vec operator()(const Vec& n) const { return solve_symmetric(block, n, fallback); }
};
/// The direction for a vertex that only inertia holds: n itself.
struct InertiaMetric {
  OGC_HD Vec operator()(const Vec& n) const { return n; }
};

namespace slide {

using Point = Vector<double>;
inline constexpr int passes = 4, nudges = 3;  ///< over the half-spaces; of a stored position, at most

/// Convert to double without loss, and back with one rounding.
OGC_HD inline Point wide(const Vec& a) { return {a.x, a.y, a.z}; }
OGC_HD inline Vec stored(const Point& a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

/// Returns how far across the plane y can move when it is stored in single precision (2⁻²⁴ of each coordinate) and
/// moved by `steps` of `nudged` (at most 2⁻²³ of one coordinate each).
OGC_HD inline double room_to_store(const HalfSpace& plane, const Point& y, int steps) {
  const Point n = wide(plane.normal);
  return (1 + 2 * steps) * 0x1p-24 * (modulus(n.x * y.x) + modulus(n.y * y.y) + modulus(n.z * y.z));
}

/// Returns how far y lies beyond the plane, plus the distance that storing it can add. It guides the search for a
/// position; `is_within` decides whether the position is taken.
OGC_HD inline double beyond(const HalfSpace& plane, const Point& y) {
  return dot(wide(plane.normal), y) - plane.offset + room_to_store(plane, y, 0);
}

/// Returns the radius within which a position may be stored, and moved by `steps`, anywhere. Storing moves each
/// coordinate by at most 2⁻²⁴ of ‖X_prev‖_∞ + b, and so the point by √3 times that; twice that leaves room for the
/// arithmetic here.
OGC_HD inline double safe_radius(const FeasibleRegion& region, int steps = 0) {
  const Point centre = wide(region.ball.centre);
  const double radius = static_cast<double>(region.ball.radius);
  const double size = larger(larger(modulus(centre.x), modulus(centre.y)), modulus(centre.z)) + radius;
  return larger(0.0, radius - (2 + 2 * steps) * 0x1p-24 * size);
}

/// Moves y along the violated half-spaces in their order, then into the ball.
template <class Metric, class Lanes>
OGC_HD Point along_planes(const FeasibleRegion& region, Point y, const Metric& metric, const Lanes& lanes) {
  const Point centre = wide(region.ball.centre);
  for (int pass = 0; pass < passes; ++pass) {
    bool moved = false;
    const auto next = [&](int from) {
      return lanes.first(region.count, from, [&](int k) { return beyond(region.planes[k], y) > 0; });
    };
    for (int k = next(0); k < region.count; k = next(k + 1)) {
      const HalfSpace& plane = region.planes[k];
      const Point n = wide(plane.normal);
      Point u = wide(metric(plane.normal));
      if (!(dot(n, u) > 0)) u = n;
      y -= (beyond(plane, y) / dot(n, u)) * u;
      moved = true;
    }
    const Point away = y - centre;
    const double length = std::sqrt(dot(away, away)), radius = safe_radius(region);
    if (length > radius) y = centre + (radius / length) * away, moved = true;
    if (!moved) break;
  }
  return y;
}

/// Moves one coordinate of x by one float towards the inside of the first plane or ball that x violates: the coordinate
/// that leads farthest inside. Storing takes a point out of a half-space by at most half a spacing of each coordinate
/// times |n_k|, so two steps of the best coordinate take it back; steps of a small coordinate, whose spacing is small,
/// would lead nowhere.
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

/// Returns the stored position, nudged if storing took it out of the region; the caller checks with `is_within` whether
/// that was enough.
template <class Lanes>
OGC_HD Vec stored_inside(const FeasibleRegion& region, const Point& y, const Lanes& lanes) {
  Vec x = stored(y);
  for (int nudge = 0; nudge < nudges && !is_within(region, x, lanes); ++nudge) x = nudged(region, x, lanes);
  return x;
}

/// The share of the way from `from`, which is in the region, to y that stays in it, with room for `steps` at its end.
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
  // ‖a + s b‖ = R; where a lies beyond the safe radius, too, as long as the way leads inward first
  const double radius = safe_radius(region, steps), bb = dot(step, step), ab = dot(away, step),
               left = radius * radius - dot(away, away), root = ab * ab + bb * left;
  if (bb > 0 && ab + ab + bb > left) share = smaller(share, root > 0 ? larger(0.0, (std::sqrt(root) - ab) / bb) : 0.0);
  return share;
}

/// The farthest stored position of the region on the way to y, or just short of it; `from` where there is none. Where
/// the way leads along one half-space and ends at another, or at the ball, a step out of one may lead out of the other:
/// then it ends so much earlier that it does not.
template <class Lanes>
OGC_HD Vec scaled(const FeasibleRegion& region, const Vec& from, const Point& y, const Lanes& lanes) {
  const Point start = wide(from);
  double share = share_inside(region, start, y, 0, lanes);
  for (int attempt = 0; attempt < 4 && share > 0; ++attempt) {
    const Vec x = stored_inside(region, start + share * (y - start), lanes);
    if (is_within(region, x, lanes)) return x;
    share = attempt == 0 ? share_inside(region, start, y, nudges, lanes) : 0.5 * share;
  }
  return from;
}

}  // namespace slide

/// A position of the region near a finite proposal outside it: along the half-spaces, nudged where storing took it out,
/// scaled towards `current` where it is still outside; in the worst case `current`, which the region holds.
template <class Metric, class Lanes>
OGC_HD OGC_OUT_OF_LINE Truncated slide_into(FeasibleRegion region, Vec current, Vec proposal, Metric metric,
                                            Lanes lanes) {
  const slide::Point y = slide::along_planes(region, slide::wide(proposal), metric, lanes);
  const Vec x = slide::stored_inside(region, y, lanes);
  return {is_within(region, x, lanes) ? x : slide::scaled(region, current, y, lanes), true};
}

/// Truncates along the straight line from `current`: for prescribed vertices, whose groups must stay rigid.
template <class Lanes>
OGC_HD OGC_OUT_OF_LINE Truncated scale_into(FeasibleRegion region, Vec current, Vec proposal, Lanes lanes) {
  return {slide::scaled(region, current, slide::wide(proposal), lanes), true};
}

}  // namespace ogc::fast
