// Makes random contacts to test the reference's contact stages. Finds closest points without Voronoi regions: by
// alternating projections, or as the nearest of all candidates.
#pragma once

#include <algorithm>
#include <vector>

#include "compare/stages/contact_force.hpp"
#include "tests/reference/energies/stencils.hpp"

namespace ogc::tests {

using compare::ContactForceCase;
using compare::ContactSides;

inline constexpr std::array<ContactSides, 4> all_sides{ContactSides::point_point, ContactSides::point_edge,
                                                       ContactSides::edge_edge, ContactSides::point_triangle};

inline Point mix(const Point& a, const Point& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

/// Returns the parameter of the point of the closed segment nearest to p.
inline double nearest(const Point& p, const Point& a, const Point& b) {
  const Point e = minus(b, a);
  return std::clamp(inner(minus(p, a), e) / inner(e, e), 0.0, 1.0);
}

/// Signed weights of the closest points: 1 in sum on the first side, −1 on the second.
using Weights = std::array<double, 4>;

inline Weights weights_of_edges(const std::array<Point, 4>& x) {
  double s = 0.5, t = 0.5;
  for (int i = 0; i < 4000; ++i) {
    t = nearest(mix(x[0], x[1], s), x[2], x[3]);
    s = nearest(mix(x[2], x[3], t), x[0], x[1]);
  }
  return {1 - s, s, t - 1, -t};
}

inline double distance_of(const std::array<Point, 4>& x, const Weights& w) {
  Point sum{};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 3; ++i) sum[i] += w[k] * (x[k][i] - x[0][i]);
  return norm(sum);
}

inline Weights weights_of_triangle(const std::array<Point, 4>& x) {
  const double ab = nearest(x[0], x[1], x[2]), bc = nearest(x[0], x[2], x[3]), ca = nearest(x[0], x[3], x[1]);
  std::vector<Weights> candidates{{1, ab - 1, -ab, 0}, {1, 0, bc - 1, -bc}, {1, -ca, 0, ca - 1}};
  const Point n = outer(minus(x[2], x[1]), minus(x[3], x[1]));
  const double b = inner(outer(minus(x[0], x[1]), minus(x[3], x[1])), n) / inner(n, n),
               c = inner(outer(minus(x[2], x[1]), minus(x[0], x[1])), n) / inner(n, n);
  if (b > 0 && c > 0 && b + c < 1) candidates.push_back({1, b + c - 1, -b, -c});
  return *std::min_element(candidates.begin(), candidates.end(),
                           [&](const Weights& v, const Weights& w) { return distance_of(x, v) < distance_of(x, w); });
}

inline Weights weights(ContactSides sides, const std::array<Point, 4>& x) {
  switch (sides) {
    case ContactSides::point_edge: {
      const double t = nearest(x[0], x[1], x[2]);
      return {1, t - 1, -t, 0};
    }
    case ContactSides::edge_edge: return weights_of_edges(x);
    case ContactSides::point_triangle: return weights_of_triangle(x);
    default: return {1, -1, 0, 0};
  }
}

inline std::array<Point, 4> points(const std::array<compare::Vec3f, 4>& x) {
  return {point(x[0]), point(x[1]), point(x[2]), point(x[3])};
}

/// Returns a contact with sides of about 1 m, 0.1 to 0.6 m apart, and r = 0.7 m; edges are nearly perpendicular.
inline ContactForceCase random_contact(Draw& draw, ContactSides sides) {
  ContactForceCase c;
  c.sides = sides;
  const std::array<compare::Vec3f, 3> second = sides == ContactSides::edge_edge
                                                   ? std::array<compare::Vec3f, 3>{{{0, -0.5f, 0}, {0, 0.5f, 0}, {}}}
                                                   : std::array<compare::Vec3f, 3>{
                                                         {{-0.5f, -0.3f, 0}, {0.6f, -0.4f, 0}, {0, 0.6f, 0}}};
  const float height = draw.single(0.1, 0.5);
  const std::size_t first = sides == ContactSides::edge_edge ? 2 : 1,
                    count = static_cast<std::size_t>(compare::vertex_count(sides));
  for (std::size_t k = 0; k < count; ++k) {
    const compare::Vec3f jitter = draw.in_box(k < first ? 0.4 : 0.15);
    compare::Vec3f base{0, 0, height};
    if (first == 2 && k < 2) base.x = k == 0 ? -0.5f : 0.5f;
    if (k >= first) base = second[k - first];
    const float lift = k < first ? 0.1f : 1;
    c.vertex[k] = {base.x + jitter.x, base.y + jitter.y, base.z + lift * jitter.z};
  }
  c.previous = c.vertex;
  c.contact_radius = 0.7f;
  c.stiffness = draw.single(1, 10);
  return c;
}

/// Returns g of Eq. 18 with Eq. 20 and the corrected Eq. 19.
inline double activation(double d, double r, double k) {
  if (d >= r) return 0;
  const double tau = r / 2;
  if (d >= tau) return k / 2 * (r - d) * (r - d);
  return -tau * k * (r - tau) * std::log(d / tau) + k / 2 * (r - tau) * (r - tau);
}

}  // namespace ogc::tests
