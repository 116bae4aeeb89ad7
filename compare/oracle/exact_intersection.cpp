// Decides with predicates of CGAL in two dimensions. Points of a plane are projected along a coordinate axis, chosen so
// that the plane does not become a line; then the projection is one-to-one. Points of a line are compared coordinate by
// coordinate. Dropping coordinates causes no rounding.
#include "compare/oracle/exact_intersection.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <optional>
#include <span>

namespace ogc::compare {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = Kernel::Point_2;

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto point = [](const Vec3& v) { return Kernel::Point_3(v.x, v.y, v.z); };
  return CGAL::orientation(point(a), point(b), point(c), point(d));
}

Point2 project(const Vec3& v, int axis) {
  if (axis == 0) return {v.y, v.z};
  return axis == 1 ? Point2(v.z, v.x) : Point2(v.x, v.y);
}

/// Returns the axis along which the three points project to a proper triangle; none if they are collinear.
std::optional<int> projection_axis(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (int axis = 0; axis < 3; ++axis)
    if (CGAL::orientation(project(a, axis), project(b, axis), project(c, axis)) != CGAL::COLLINEAR) return axis;
  return std::nullopt;
}

/// Returns whether c lies in the box around a and b. If the points are collinear, this is the closed segment ab.
bool within(const Point2& a, const Point2& b, const Point2& c) {
  const auto between = [](double s, double t, double u) { return std::min(s, t) <= u && u <= std::max(s, t); };
  return between(a.x(), b.x(), c.x()) && between(a.y(), b.y(), c.y());
}

bool planar_segments_meet(const Point2& p, const Point2& q, const Point2& a, const Point2& b) {
  const int pa = CGAL::orientation(p, q, a), pb = CGAL::orientation(p, q, b);
  const int ap = CGAL::orientation(a, b, p), aq = CGAL::orientation(a, b, q);
  if (pa * pb < 0 && ap * aq < 0) return true;
  return (pa == 0 && within(p, q, a)) || (pb == 0 && within(p, q, b)) || (ap == 0 && within(a, b, p)) ||
         (aq == 0 && within(a, b, q));
}

/// Returns whether a proper, closed triangle contains the point.
bool planar_triangle_holds(const std::array<Point2, 3>& t, const Point2& p) {
  const int s0 = CGAL::orientation(t[0], t[1], p), s1 = CGAL::orientation(t[1], t[2], p),
            s2 = CGAL::orientation(t[2], t[0], p);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

bool planar_segment_meets_triangle(const std::array<Vec3, 2>& segment, const std::array<Vec3, 3>& triangle, int axis) {
  const std::array<Point2, 3> t{project(triangle[0], axis), project(triangle[1], axis), project(triangle[2], axis)};
  const Point2 p = project(segment[0], axis), q = project(segment[1], axis);
  if (planar_triangle_holds(t, p) || planar_triangle_holds(t, q)) return true;
  return planar_segments_meet(p, q, t[0], t[1]) || planar_segments_meet(p, q, t[1], t[2]) ||
         planar_segments_meet(p, q, t[2], t[0]);
}

/// Returns whether the segments meet. All four points must lie on one line, or be equal.
bool collinear_segments_meet(const std::array<Vec3, 2>& first, const std::array<Vec3, 2>& second) {
  const auto overlap = [](double a, double b, double c, double d) {
    return std::max(std::min(a, b), std::min(c, d)) <= std::min(std::max(a, b), std::max(c, d));
  };
  return overlap(first[0].x, first[1].x, second[0].x, second[1].x) &&
         overlap(first[0].y, first[1].y, second[0].y, second[1].y) &&
         overlap(first[0].z, first[1].z, second[0].z, second[1].z);
}

}  // namespace

bool segments_meet(const std::array<Vec3, 2>& first, const std::array<Vec3, 2>& second) {
  const auto& [p, q] = first;
  const auto& [a, b] = second;
  if (orientation(p, q, a, b) != 0) return false;
  for (const auto& triple : {std::array{p, q, a}, std::array{p, q, b}, std::array{a, b, p}, std::array{a, b, q}})
    if (const auto axis = projection_axis(triple[0], triple[1], triple[2]))
      return planar_segments_meet(project(p, *axis), project(q, *axis), project(a, *axis), project(b, *axis));
  return collinear_segments_meet(first, second);
}

bool segment_meets_triangle(const std::array<Vec3, 2>& segment, const std::array<Vec3, 3>& triangle) {
  const auto& [p, q] = segment;
  const auto& [a, b, c] = triangle;
  const int side_p = orientation(a, b, c, p), side_q = orientation(a, b, c, q);
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) {
    if (const auto axis = projection_axis(a, b, c)) return planar_segment_meets_triangle(segment, triangle, *axis);
    return segments_meet(segment, {a, b}) || segments_meet(segment, {b, c}) || segments_meet(segment, {c, a});
  }
  const int s0 = orientation(p, q, a, b), s1 = orientation(p, q, b, c), s2 = orientation(p, q, c, a);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

}  // namespace ogc::compare
