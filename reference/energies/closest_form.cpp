#include "reference/energies/closest_form.hpp"

#include <algorithm>

namespace ogc::reference {
namespace {

using Corners = std::array<Triple<double>, 4>;

ClosestForm points(std::uint8_t a, std::uint8_t b) {
  ClosestForm form{FormKind::points, {a, b}, {}};
  form.weight[a] = 1;
  form.weight[b] = -1;
  return form;
}

/// Returns the closest points of vertex p and the segment ab. p is the contact's first side.
ClosestForm point_segment(const Corners& x, std::uint8_t p, std::uint8_t a, std::uint8_t b) {
  const Triple<double> edge = x[b] - x[a];
  const double along = dot(x[p] - x[a], edge), whole = dot(edge, edge);
  if (along <= 0 || whole == 0) return points(p, a);
  if (along >= whole) return points(p, b);
  ClosestForm form{FormKind::point_line, {p, a, b}, {}};
  form.weight[p] = 1;
  form.weight[a] = along / whole - 1;
  form.weight[b] = -along / whole;
  return form;
}

double squared_distance(const ClosestForm& form, const Corners& x) {
  const Triple<double> apart = separation(form.weight, x);
  return dot(apart, apart);
}

const ClosestForm& nearer(const ClosestForm& a, const ClosestForm& b, const Corners& x) {
  return squared_distance(b, x) < squared_distance(a, x) ? b : a;
}

/// Returns the closest points of a point and a triangle. If the point's foot on the plane lies inside the triangle, the
/// triangle's point is the foot. Otherwise it lies on the nearest edge.
ClosestForm point_triangle(const Corners& x) {
  const Triple<double> u = x[2] - x[1], v = x[3] - x[1], w = x[0] - x[1], normal = cross(u, v);
  const double area = dot(normal, normal), second = dot(cross(w, v), normal), third = dot(cross(u, w), normal);
  if (area > 0 && second > 0 && third > 0 && second + third < area)
    return {FormKind::point_plane, {0, 1, 2, 3}, {1, (second + third) / area - 1, -second / area, -third / area}};
  const ClosestForm first = point_segment(x, 0, 1, 2), middle = point_segment(x, 0, 2, 3),
                    last = point_segment(x, 0, 3, 1);
  return nearer(nearer(first, middle, x), last, x);
}

ClosestForm negated(ClosestForm form) {
  for (double& w : form.weight) w = -w;
  return form;
}

double clamped(double s) { return std::clamp(s, 0.0, 1.0); }

/// Applies the rule for nearly parallel edges (method.md §1.4) if ‖e×e'‖² < 10⁻⁶‖e‖²‖e'‖² and the projections overlap.
/// Sets `form` to the middle of the overlap on the first edge and the middle's projection on the second edge. Returns
/// whether the rule applies.
bool parallel_rule(const Corners& x, ClosestForm& form) {
  const Triple<double> u = x[1] - x[0], v = x[3] - x[2], normal = cross(u, v);
  const double uu = dot(u, u), vv = dot(v, v);
  if (!(1e6 * dot(normal, normal) < uu * vv)) return false;
  const double begin = clamped(dot(x[2] - x[0], u) / uu), end = clamped(dot(x[3] - x[0], u) / uu);
  if (begin == end) return false;
  const double s = 0.5 * (begin + end), t = clamped(dot(x[0] + s * u - x[2], v) / vv);
  form = {FormKind::fixed_weights, {0, 1, 2, 3}, {1 - s, s, t - 1, -t}};
  return true;
}

ClosestForm edge_edge(const Corners& x) {
  ClosestForm form;
  return parallel_rule(x, form) ? form : closest_edges(x);
}

}  // namespace

/// Returns the closest points of two edges. If the angle between the edges is below 2⁻²⁰, one of the points is an end
/// of an edge, because rounding makes the common normal of the lines meaningless. The distance is then wrong by at most
/// 2⁻²⁰ of an edge's length.
ClosestForm closest_edges(const Corners& x) {
  const Triple<double> u = x[1] - x[0], v = x[3] - x[2], w = x[2] - x[0], normal = cross(u, v);
  const double area = dot(normal, normal), s = dot(cross(w, v), normal), t = dot(cross(w, u), normal);
  if (area > 0x1p-40 * dot(u, u) * dot(v, v) && s > 0 && s < area && t > 0 && t < area)
    return {FormKind::lines, {0, 1, 2, 3}, {1 - s / area, s / area, t / area - 1, -t / area}};
  const ClosestForm a = point_segment(x, 0, 2, 3), b = point_segment(x, 1, 2, 3);
  const ClosestForm c = negated(point_segment(x, 2, 0, 1)), d = negated(point_segment(x, 3, 0, 1));
  return nearer(nearer(a, b, x), nearer(c, d, x), x);
}

ClosestForm closest_form(compare::ContactSides sides, const Corners& x) {
  switch (sides) {
    case compare::ContactSides::point_edge: return point_segment(x, 0, 1, 2);
    case compare::ContactSides::edge_edge: return edge_edge(x);
    case compare::ContactSides::point_triangle: return point_triangle(x);
    case compare::ContactSides::point_point: break;
  }
  return points(0, 1);
}

}  // namespace ogc::reference
