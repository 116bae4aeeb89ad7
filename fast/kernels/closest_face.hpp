// Computes the distance of a point and a triangle in rounded double, with a bound of its error, the slack. Exact signs
// find the face that holds the closest point. The distance is continuous across faces, so its computation does not need
// this face; only pairs nearer than r need the face.
#pragma once

#include "compare/stages/closest_face.hpp"
#include "fast/kernels/predicates.hpp"
#include "fast/kernels/segment.hpp"

namespace ogc::fast {

using compare::TriangleFeature;

/// Holds the corners of a triangle in the order of the mesh.
template <class T>
struct CornersOf {
  Vector<T> a, b, c;  ///< [m]

  OGC_HD const Vector<T>& operator[](int k) const { return k == 0 ? a : (k == 1 ? b : c); }
};
using Corners = CornersOf<float>;

/// Returns whether x is certainly on the inner side of the edge e of a triangle: the value of Side (predicates.hpp)
/// exceeds its rounding error. u is x minus the edge's first end, w the third corner minus this end.
OGC_HD inline bool is_inside(const Real& u, const Real& w, const Real& e) {
  return perpendicular_product(u, w, e).value > mul(mul(mul(0x1p-48, norm_1(u)), norm_1(w)), squared(e));
}

/// Returns the distance of x and the closed triangle, with its slack. If it is uncertain on which side of an edge x
/// lies, returns the distance to the outline. This distance is exact if x projects outside. If x projects inside, it is
/// at most √3 2⁻⁴⁸ S L²/‖n‖ too large, with L the longest edge, n the normal and S = `size`. The normal's 4 roundings
/// tilt the plane by less than 2⁻⁵¹ S L²/‖n‖, so the slack is 2⁻⁴⁷ S L²/‖n‖. A triangle lower than 2⁻²⁴ L is replaced
/// by its outline: no point of the triangle is farther than 2⁻²⁴ L from the outline. In both cases the slack is under
/// 2⁻²³ S.
OGC_HD inline Distance point_triangle_distance(const Vec& x, const Corners& t) {
  const Real u = difference<Rounded>(x, t.a), v = difference<Rounded>(x, t.b), e = difference<Rounded>(t.b, t.a),
             w = difference<Rounded>(t.c, t.a);
  const Real f = difference<Rounded>(t.c, t.b), n = cross(e, w);
  const double nn = squared(n), longest = larger(larger(squared(e), squared(w)), squared(f)),
               longest_4 = mul(longest, longest);
  const double size = add(add(norm_1(u), norm_1(e)), norm_1(w));
  const bool has_inside = nn > mul(0x1p-48, longest_4);

  double slack = mul(0x1p-39, size);  // L²/‖n‖ ≤ 2⁸: nearly all triangles
  if (!has_inside) {
    slack = add(mul(0x1p-46, size), mul(0x1p-24, square_root(longest)));
  } else if (nn < mul(0x1p-16, longest_4)) {
    slack = mul(mul(0x1p-47, size), square_root(divide(longest_4, nn)));
  }
  if (has_inside && is_inside(u, w, e) && is_inside(u, e, w) && is_inside(v, -e, f)) {
    return {divide(modulus(dot(u, n).value), square_root(nn)), slack};
  }
  const double nearest = smaller(smaller(squared_to_segment(u, e), squared_to_segment(u, w)), squared_to_segment(v, f));
  return {square_root(nearest), slack};
}

/// Value of Facet::descending for a triangle with ascending corners.
inline constexpr unsigned corners_in_order = 4;

/// Returns the face of the triangle that holds the point closest to x. Where two faces meet, it is the one of lower
/// dimension. The signs assign each x to one face; for a triangle without area several faces may fit, and the first is
/// taken. `descending` is explained at Facet.
OGC_HD inline TriangleFeature closest_feature(const Vec& x, const Corners& t, unsigned descending = corners_in_order) {
  // [k][i]: x does not project beyond end i of edge k, which goes from corner k to corner k + 1
  bool before[3][2];
  for (int k = 0; k < 3; ++k) {
    const Vec &a = t[k], &b = t[(k + 1) % 3];
    before[k][0] = exact_sign(End{x, a, b}) > 0;
    before[k][1] = exact_sign(End{x, b, a}) > 0;
  }
  for (int k = 0; k < 3; ++k) {
    if (!before[k][0] && !before[(k + 2) % 3][1]) return static_cast<TriangleFeature>(k);
  }
  for (int k = 0; k < 3; ++k) {
    if (!before[k][0] || !before[k][1]) continue;
    const Vec &a = t[k], &b = t[(k + 1) % 3], &c = t[(k + 2) % 3];
    const bool swap = (descending >> k & 1U) != 0;
    if (exact_sign(Side{x, swap ? b : a, swap ? a : b, c}) <= 0) return static_cast<TriangleFeature>(3 + k);
  }
  return TriangleFeature::interior;
}

/// Returns the barycentric weights, ≥ 0, of the point of `feature` closest to x.
OGC_HD inline Vec closest_weights(const Vec& x, const Corners& t, TriangleFeature feature) {
  const auto on_edge = [&x](const Vec& a, const Vec& b) {
    return segment_parameter(difference<Rounded>(x, a), difference<Rounded>(b, a));
  };
  const auto stored = [](double a, double b, double c) {
    return Vec{static_cast<float>(a), static_cast<float>(b), static_cast<float>(c)};
  };
  switch (feature) {
    case TriangleFeature::corner_0: return {1, 0, 0};
    case TriangleFeature::corner_1: return {0, 1, 0};
    case TriangleFeature::corner_2: return {0, 0, 1};
    case TriangleFeature::edge_01: return stored(sub(1.0, on_edge(t.a, t.b)), on_edge(t.a, t.b), 0);
    case TriangleFeature::edge_12: return stored(0, sub(1.0, on_edge(t.b, t.c)), on_edge(t.b, t.c));
    case TriangleFeature::edge_20: return stored(sub(1.0, on_edge(t.a, t.c)), 0, on_edge(t.a, t.c));
    case TriangleFeature::interior: break;
  }
  const Real u = difference<Rounded>(x, t.a), e = difference<Rounded>(t.b, t.a), w = difference<Rounded>(t.c, t.a),
             n = cross(e, w);
  const double nn = squared(n), at_b = divide(dot(cross(u, w), n).value, nn),
               at_c = divide(dot(cross(e, u), n).value, nn);
  return stored(larger(0.0, sub(sub(1.0, at_b), at_c)), larger(0.0, at_b), larger(0.0, at_c));
}

/// Returns whether x is nearer than r to the triangle. `feature` is its closest face, `d` its distance. If d is within
/// its slack of r, an exact predicate decides.
OGC_HD inline bool is_within(const Vec& x, const Corners& t, TriangleFeature feature, const Distance& d, float r) {
  if (modulus(sub(d.value, static_cast<double>(r))) > d.slack) return d.value < static_cast<double>(r);
  switch (feature) {
    case TriangleFeature::corner_0:
    case TriangleFeature::corner_1:
    case TriangleFeature::corner_2: return exact_sign(PointReach{x, t[static_cast<int>(feature)], r}) < 0;
    case TriangleFeature::edge_01: return exact_sign(LineReach{x, t.a, t.b, r}) < 0;
    case TriangleFeature::edge_12: return exact_sign(LineReach{x, t.b, t.c, r}) < 0;
    case TriangleFeature::edge_20: return exact_sign(LineReach{x, t.a, t.c, r}) < 0;
    case TriangleFeature::interior: break;
  }
  return exact_sign(PlaneReach{x, t.a, t.b, t.a, t.c, r}) < 0;
}

}  // namespace ogc::fast
