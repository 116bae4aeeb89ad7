// Uses one edge at a vertex v to decide whether the segment from v to x begins outside. The normals at v form a convex
// cone N_v that meets the star of v only in v. So all normals lie on one side of the surface. (A flat vertex has two
// opposite normals, and each is perpendicular to every edge.)
//
// Choose a normal g in N_v that is perpendicular to an edge at v, and a small ε > 0. The point v + ε g can move
// parallel to this edge without meeting the star, because g·w > 0 for these points w (relative to v) and g·w ≤ 0 for
// points of the star. Hence v + ε g lies on the same side of the surface as a point just above the edge. The edge's two
// triangles decide on which side that point lies.
#include "reference/definitions/closed_surface.hpp"

#include <algorithm>

#include "compare/problem/error.hpp"
#include "reference/definitions/normal_cone.hpp"

namespace ogc::reference {
namespace {

ExactVector normal(const Complex& mesh, Index t) {
  const auto [a, b, c] = mesh.triangle(t);
  return cross(exact(mesh.at(b)) - exact(mesh.at(a)), exact(mesh.at(c)) - exact(mesh.at(a)));
}

/// Returns whether the triangle runs through edge (a, b) from a to b.
bool runs_along(const compare::Triangle& triangle, const compare::Edge& edge) {
  for (std::size_t k = 0; k < 3; ++k)
    if (triangle[k] == edge[0] && triangle[(k + 1) % 3] == edge[1]) return true;
  return false;
}

/// Returns < 0 if the edge is a ridge seen from outside, > 0 if it is a valley, 0 if its triangles are coplanar.
int bend(const Complex& mesh, Index edge) {
  const auto triangles = mesh.triangles_of(edge);
  const ExactVector a = exact(mesh.at(mesh.edge(edge)[0]));
  return sign_of(dot(normal(mesh, triangles[0]), exact(mesh.at(mesh.opposite(triangles[1], edge))) - a));
}

bool is_rim(const Complex& mesh, Index edge) { return mesh.triangles_of(edge).size() == 1; }

/// Returns whether the edge's two triangles are folded onto each other: coplanar, and both on the same side of the
/// edge.
bool is_folded(const Complex& mesh, Index edge) {
  const auto triangles = mesh.triangles_of(edge);
  return bend(mesh, edge) == 0 && sign_of(dot(normal(mesh, triangles[0]), normal(mesh, triangles[1]))) < 0;
}

std::string name(const char* kind, Index number, std::span<const Index> vertices) {
  std::string text = kind + std::string(" ") + std::to_string(number) + " (vertices";
  for (const Index v : vertices) text += " " + std::to_string(v);
  return text + ")";
}

[[noreturn]] void refuse(const std::string& what) { throw compare::InputError("closed surface: " + what); }

void check_edge(const Complex& mesh, Index e) {
  const compare::Edge& edge = mesh.edge(e);
  const auto triangles = mesh.triangles_of(e);
  if (triangles.size() != 2)
    refuse(name("edge", e, edge) + " belongs to " + std::to_string(triangles.size()) + " triangle" +
           (triangles.size() == 1 ? "" : "s") +
           ", and a closed surface has two at every edge; close the hole or take the sheet for what it is, a surface "
           "with two sides");
  if (runs_along(mesh.triangle(triangles[0]), edge) == runs_along(mesh.triangle(triangles[1]), edge))
    refuse("triangles " + std::to_string(triangles[0]) + " and " + std::to_string(triangles[1]) + " run through " +
           name("edge", e, edge) + " in the same sense; turn one of them round");
}

void check_fold(const Complex& mesh, Index e) {
  if (!is_folded(mesh, e)) return;
  const auto triangles = mesh.triangles_of(e);
  refuse("triangles " + std::to_string(triangles[0]) + " and " + std::to_string(triangles[1]) +
         " lie folded onto each other along " + name("edge", e, mesh.edge(e)) + "; nothing says which side is outside");
}

void check_volume(const Complex& mesh) {
  Exact volume(0);
  for (std::size_t t = 0; t < mesh.topology.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.topology.triangles[t];
    volume = volume + dot(exact(mesh.at(a)), cross(exact(mesh.at(b)), exact(mesh.at(c))));
  }
  if (sign_of(volume) <= 0)
    refuse(std::string("it encloses ") +
           (volume.is_zero() ? "no volume"
                             : "a negative volume: its triangles, 0 the first, face inward; turn them round"));
}

bool outward_of_edge(const Complex& mesh, Index edge, const Vec3f& x) {
  const ExactVector a = exact(mesh.at(mesh.edge(edge)[0])), b = exact(mesh.at(mesh.edge(edge)[1])), p = exact(x);
  if (is_rim(mesh, edge)) return true;
  const int sense = bend(mesh, edge);
  if (sense == 0) return is_folded(mesh, edge) || sign_of(dot(normal(mesh, mesh.triangles_of(edge)[0]), p - a)) >= 0;
  return sense < 0 || is_zero(cross(b - a, p - a));
}

bool outward_of_vertex(const Complex& mesh, Index vertex, const Vec3f& x) {
  const ExactVector v = exact(mesh.at(vertex)), w = exact(x) - v;
  if (is_zero(w)) return true;
  const auto spokes = mesh.edges_of(vertex);
  if (std::ranges::any_of(spokes, [&](Index e) { return is_rim(mesh, e) || is_folded(mesh, e); })) return true;
  const auto touched_by = [&](const ExactVector& g) {
    return std::find_if(spokes.begin(), spokes.end(),
                        [&](Index e) { return dot(g, exact(mesh.at(mesh.across(e, vertex))) - v).is_zero(); });
  };
  ExactVector g = w;
  auto spoke = touched_by(g);
  if (spoke == spokes.end()) {
    const NormalCone cone(star_directions(mesh, vertex_face(vertex)));
    if (cone.generators().empty()) return false;
    g = cone.generators().front();
    spoke = touched_by(g);
  }
  const int sense = bend(mesh, *spoke);
  return sense < 0 || (sense == 0 && sign_of(dot(normal(mesh, mesh.triangles_of(*spoke)[0]), g)) > 0);
}

/// Returns whether the closed triangle holds x; n is its normal, which must not be 0.
bool holds_point(const std::array<ExactVector, 3>& corners, const ExactVector& n, const ExactVector& x) {
  if (!dot(n, x - corners[0]).is_zero()) return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (sign_of(dot(cross(corners[(k + 1) % 3] - corners[k], x - corners[k]), n)) < 0) return false;
  return true;
}

/// Returns the sign of a · (1, ε, ε²) for a vanishing ε > 0.
int generic_sign(const ExactVector& a) {
  for (const Exact* component : {&a.x, &a.y, &a.z})
    if (!component->is_zero()) return sign_of(*component);
  return 0;
}

/// Returns 1 if the ray from x crosses the triangle along the normal n, −1 if it crosses against n, 0 if it misses the
/// triangle. x must not be on the triangle.
int crossing(const std::array<ExactVector, 3>& corners, const ExactVector& n, const ExactVector& x) {
  const int direction = generic_sign(n);
  for (std::size_t k = 0; k < 3; ++k)
    if (generic_sign(cross(corners[k] - x, corners[(k + 1) % 3] - x)) != direction) return 0;
  return sign_of(dot(n, corners[0] - x)) == direction ? direction : 0;
}

}  // namespace

ClosedSurface::ClosedSurface(const Complex& mesh) : mesh_(mesh) {
  const auto edges = static_cast<Index>(mesh.topology.edges.size()),
             triangles = static_cast<Index>(mesh.topology.triangles.size());
  for (Index e = 0; e < edges; ++e) check_edge(mesh, e);
  for (Index t = 0; t < triangles; ++t)
    if (is_zero(normal(mesh, t))) refuse(name("triangle", t, mesh.triangle(t)) + " has no area; remove it");
  for (Index e = 0; e < edges; ++e) check_fold(mesh, e);
  check_volume(mesh);
}

bool begins_outside(const Complex& mesh, Face face, const Vec3f& x) {
  if (face.kind == FaceKind::vertex) return outward_of_vertex(mesh, face.index, x);
  if (face.kind == FaceKind::edge) return outward_of_edge(mesh, face.index, x);
  return sign_of(dot(normal(mesh, face.index), exact(x) - exact(mesh.at(mesh.triangle(face.index)[0])))) >= 0;
}

bool ClosedSurface::outward(Face face, const Vec3f& x) const { return begins_outside(mesh_, face, x); }

bool ClosedSurface::in_outward_block(Face face, const Vec3f& x, float contact_radius) const {
  return in_block(mesh_, face, x, contact_radius) && outward(face, x);
}

PointLocation ClosedSurface::locate(const Vec3f& x) const {
  const ExactVector p = exact(x);
  int winding = 0;
  for (std::size_t t = 0; t < mesh_.topology.triangles.size(); ++t) {
    const auto [a, b, c] = mesh_.topology.triangles[t];
    const std::array<ExactVector, 3> corners{exact(mesh_.at(a)), exact(mesh_.at(b)), exact(mesh_.at(c))};
    const ExactVector n = normal(mesh_, static_cast<Index>(t));
    if (holds_point(corners, n, p)) return {true, 0};
    winding += crossing(corners, n, p);
  }
  return {false, winding};
}

}  // namespace ogc::reference
