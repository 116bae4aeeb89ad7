#include "reference/definitions/pair_margins.hpp"

#include <cmath>

#include "reference/definitions/normal_cone.hpp"
#include "reference/geometry/closest_points.hpp"

namespace ogc::reference {
namespace {

/// Returns a + (s/weight) d; `weight` must be > 0.
ExactPoint point_at(const ExactVector& a, const ExactVector& d, const Exact& s, const Exact& weight) {
  return {plus(times(weight, a), times(s, d)), weight};
}

/// Returns the point of `face` closest to the point or line of `other`; two lines must not be parallel.
ExactPoint closest_on(const Complex& mesh, Face face, Face other) {
  const auto ends = mesh.vertices(face).items, others = mesh.vertices(other).items;
  const ExactVector a = exact(mesh.at(ends[0])), c = exact(mesh.at(others[0]));
  if (face.kind == FaceKind::vertex) return {a, Exact(1)};
  const ExactVector u = exact(mesh.at(ends[1])) - a;
  if (other.kind == FaceKind::vertex) return point_at(a, u, dot(c - a, u), dot(u, u));
  const ExactVector v = exact(mesh.at(others[1])) - c, n = cross(u, v);
  return point_at(a, u, dot(cross(c - a, v), n), dot(n, n));
}

/// Returns the margin of x from the plane through `at` that is perpendicular to the line from `at` to `towards`. If
/// `inward` is 1, the margin is positive on the side of `towards`. If `inward` is −1, it is positive on the other side.
BlockMargin end_plane(const Complex& mesh, Index at, Index towards, int inward, Face across, const ExactPoint& x) {
  const ExactVector p = exact(mesh.at(at)), d = exact(mesh.at(towards)) - p;
  const Exact m = dot(x.numerator - times(x.weight, p), d);
  const double length = m.to_double() / (x.weight.to_double() * std::sqrt(dot(d, d).to_double()));
  return {BlockMargin::Kind::end, across, inward * sign_of(m), inward * length, inward < 0};
}

std::vector<BlockMargin> margins_of(const Complex& mesh, Face face, const ExactPoint& x, const Margin& gap) {
  std::vector<BlockMargin> margins{{BlockMargin::Kind::sphere, face, -sign(gap), -signed_length(gap), true}};
  if (face.kind == FaceKind::vertex) {
    for (const Index e : mesh.edges_of(face.index))
      margins.push_back(end_plane(mesh, face.index, mesh.across(e, face.index), -1, edge_face(e), x));
  } else {
    const auto [a, b] = mesh.edge(face.index);
    margins.push_back(end_plane(mesh, a, b, 1, vertex_face(a), x));
    margins.push_back(end_plane(mesh, b, a, 1, vertex_face(b), x));
  }
  return margins;
}

}  // namespace

PairMargins pair_margins(const Complex& mesh, const compare::EdgeEdgeContact& contact, float contact_radius) {
  const Face p = contact.first, q = contact.second;
  const auto ends = [&](Face edge) {
    return std::array<Vec3f, 2>{mesh.at(mesh.edge(edge.index)[0]), mesh.at(mesh.edge(edge.index)[1])};
  };
  if (p.kind == FaceKind::edge && q.kind == FaceKind::edge && nearly_parallel({ends(p), ends(q)})) return {};
  const Margin gap = pair_gap(mesh, ordered(p, q), contact_radius);
  return {margins_of(mesh, p, closest_on(mesh, q, p), gap), margins_of(mesh, q, closest_on(mesh, p, q), gap)};
}

}  // namespace ogc::reference
