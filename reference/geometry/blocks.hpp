// Writes block membership as conditions: Eq. 8–10 (blocks of the surface), 14 and 15 (edge-only manifold). Each
// condition comes with the face on the other side of its boundary.
#pragma once

#include <span>

#include "compare/problem/exclusions.hpp"
#include "compare/stages/closest_face.hpp"
#include "compare/stages/closest_points.hpp"
#include "reference/geometry/conditions.hpp"

namespace ogc::reference {

using compare::Face;
using compare::FaceKind;
using compare::Index;

/// A mesh at given positions. It holds views; the owner must outlive it.
struct Complex {
  const compare::Topology& topology;  ///< of the mesh
  std::span<const Vec3f> positions;   ///< by vertex [m]

  /// Returns the position of a vertex [m].
  const Vec3f& at(Index vertex) const { return positions[static_cast<std::size_t>(vertex)]; }
  /// Returns the ends of an edge.
  const compare::Edge& edge(Index e) const { return topology.edges[static_cast<std::size_t>(e)]; }
  /// Returns the corners of a triangle.
  const compare::Triangle& triangle(Index t) const { return topology.triangles[static_cast<std::size_t>(t)]; }
  /// Returns the edges that end at a vertex.
  std::span<const Index> edges_of(Index vertex) const {
    return topology.vertex_edges[static_cast<std::size_t>(vertex)];
  }
  /// Returns the triangles of an edge.
  std::span<const Index> triangles_of(Index e) const { return topology.edge_triangles[static_cast<std::size_t>(e)]; }
  /// Returns the vertex of edge e that is not `vertex`.
  Index across(Index e, Index vertex) const { return edge(e)[0] == vertex ? edge(e)[1] : edge(e)[0]; }
  /// Returns whether no triangle contains edge e.
  bool is_loose(Index e) const { return triangles_of(e).empty(); }
  /// Returns the vertex of triangle t that is not on edge e.
  Index opposite(Index t, Index e) const;
  /// The vertices of a face; the first `count` are used.
  struct Vertices {
    std::array<Index, 3> items{-1, -1, -1};  ///< only the first `count` are set
    int count = 0;                           ///< 1, 2 or 3
    /// Returns the first `count` vertices.
    std::span<const Index> span() const { return {items.data(), static_cast<std::size_t>(count)}; }
  };
  Vertices vertices(Face face) const;  ///< Returns the vertices of a face.
};

/// Returns a vertex as a face.
inline Face vertex_face(Index v) { return {FaceKind::vertex, v}; }
/// Returns an edge as a face.
inline Face edge_face(Index e) { return {FaceKind::edge, e}; }
/// Returns a triangle as a face.
inline Face triangle_face(Index t) { return {FaceKind::triangle, t}; }

/// Returns a feature of a triangle as a face.
inline Face face_of(const Complex& mesh, Index triangle, compare::TriangleFeature feature) {
  const auto f = static_cast<std::size_t>(feature);
  if (f < 3) return vertex_face(mesh.triangle(triangle)[f]);
  if (f < 6) return edge_face(mesh.topology.triangle_edges[static_cast<std::size_t>(triangle)][f - 3]);
  return triangle_face(triangle);
}
/// Returns a feature of an edge as a face.
inline Face face_of(const Complex& mesh, Index edge, compare::EdgeFeature feature) {
  if (feature == compare::EdgeFeature::interior) return edge_face(edge);
  return vertex_face(mesh.edge(edge)[static_cast<std::size_t>(feature)]);
}

/// A condition of a block, and the face whose block begins where the condition fails.
struct Boundary {
  Condition condition;
  Face across;
};

/// Visits all conditions of U_a for the point x, except the distance (Eq. 8, 9, 10); visit(Boundary) returns false to
/// stop. A margin that two faces share has the same order of vertices for both faces.
template <class Visit>
void visit_block(const Complex& mesh, Face face, const Vec3f& x, Visit visit) {
  if (face.kind == FaceKind::vertex) {
    for (const Index e : mesh.edges_of(face.index)) {
      if (!visit(Boundary{{along(mesh.at(face.index), mesh.at(mesh.across(e, face.index)), x), false}, edge_face(e)}))
        return;
    }
  } else if (face.kind == FaceKind::edge) {
    const auto [a, b] = mesh.edge(face.index);
    if (!visit(Boundary{{along(mesh.at(a), mesh.at(b), x), true}, vertex_face(a)})) return;
    if (!visit(Boundary{{along(mesh.at(b), mesh.at(a), x), true}, vertex_face(b)})) return;
    for (const Index t : mesh.triangles_of(face.index)) {
      if (!visit(Boundary{{side(mesh.at(a), mesh.at(b), mesh.at(mesh.opposite(t, face.index)), x), false},
                          triangle_face(t)}))
        return;
    }
  } else {
    for (const Index e : mesh.topology.triangle_edges[static_cast<std::size_t>(face.index)]) {
      const auto [a, b] = mesh.edge(e);
      if (!visit(
              Boundary{{side(mesh.at(a), mesh.at(b), mesh.at(mesh.opposite(face.index, e)), x), true}, edge_face(e)}))
        return;
    }
  }
}

/// Returns d² − r² (a gap) of x and the point, line or plane of a face.
Margin face_gap(const Complex& mesh, Face face, const Vec3f& x, float contact_radius);

/// Checks whether x ∈ U_a, closed at distance r (Eq. 8, 9, 10).
bool in_block(const Complex& mesh, Face face, const Vec3f& x, float contact_radius);

/// Checks whether x ∈ U_a^E for a vertex or an edge (Eq. 14, 15).
bool in_edge_only_block(const Complex& mesh, Face face, const Vec3f& x, float contact_radius);

/// Two faces of the edge-only manifold.
struct FacePair {
  Face first, second;  ///< a vertex or an edge each
  friend auto operator<=>(const FacePair&, const FacePair&) = default;
};
/// Returns the pair with the lower-numbered face first.
inline FacePair ordered(Face a, Face b) { return a < b ? FacePair{a, b} : FacePair{b, a}; }

/// A condition under which a pair of faces has the closest points, and the pair that has them if the condition fails.
struct PairBoundary {
  Condition condition;  ///< holds if this pair has the closest points
  FacePair across;      ///< has the closest points if the condition fails
};

/// Visits the conditions under which vertex p and the interior of edge e have the closest points: each closest point
/// lies in the block of the other face (Eq. 14, 15, 17).
template <class Visit>
void visit_vertex_edge(const Complex& mesh, Index p, Index e, Visit visit) {
  const auto [a, b] = mesh.edge(e);
  const Vec3f& x = mesh.at(p);
  if (!visit(PairBoundary{{along(mesh.at(a), mesh.at(b), x), true}, ordered(vertex_face(p), vertex_face(a))})) return;
  if (!visit(PairBoundary{{along(mesh.at(b), mesh.at(a), x), true}, ordered(vertex_face(p), vertex_face(b))})) return;
  for (const Index f : mesh.edges_of(p)) {
    const Margin step = turn(x, mesh.at(mesh.across(f, p)), mesh.at(a), mesh.at(b));
    if (!visit(PairBoundary{{step, false}, ordered(edge_face(f), edge_face(e))})) return;
  }
}

/// Visits the conditions under which vertices p and q lie in each other's blocks (Eq. 15 twice).
template <class Visit>
void visit_vertex_vertex(const Complex& mesh, Index p, Index q, Visit visit) {
  for (const Index e : mesh.edges_of(p)) {
    const Margin step = along(mesh.at(p), mesh.at(mesh.across(e, p)), mesh.at(q));
    if (!visit(PairBoundary{{step, false}, ordered(edge_face(e), vertex_face(q))})) return;
  }
  for (const Index e : mesh.edges_of(q)) {
    const Margin step = along(mesh.at(q), mesh.at(mesh.across(e, q)), mesh.at(p));
    if (!visit(PairBoundary{{step, false}, ordered(edge_face(e), vertex_face(p))})) return;
  }
}

/// Visits the conditions under which the interiors of edges e and f have the closest points (Eq. 14 twice).
template <class Visit>
void visit_edge_edge(const Complex& mesh, Index e, Index f, Visit visit) {
  const auto [p0, p1] = mesh.edge(e);
  const auto [q0, q1] = mesh.edge(f);
  const Vec3f &a = mesh.at(p0), &b = mesh.at(p1), &c = mesh.at(q0), &d = mesh.at(q1);
  if (!visit(PairBoundary{{turn(a, b, c, d), true}, ordered(vertex_face(p0), edge_face(f))})) return;
  if (!visit(PairBoundary{{turn(b, a, c, d), true}, ordered(vertex_face(p1), edge_face(f))})) return;
  if (!visit(PairBoundary{{turn(c, d, a, b), true}, ordered(vertex_face(q0), edge_face(e))})) return;
  visit(PairBoundary{{turn(d, c, a, b), true}, ordered(vertex_face(q1), edge_face(e))});
}

/// Visits all conditions of an ordered pair except the distance; visit(PairBoundary) returns false to stop.
template <class Visit>
void visit_pair(const Complex& mesh, const FacePair& pair, Visit visit) {
  if (pair.first.kind == FaceKind::edge) return visit_edge_edge(mesh, pair.first.index, pair.second.index, visit);
  if (pair.second.kind == FaceKind::edge) return visit_vertex_edge(mesh, pair.first.index, pair.second.index, visit);
  visit_vertex_vertex(mesh, pair.first.index, pair.second.index, visit);
}

/// Returns d² − r² (a gap) of the two points, the point and the line, or the two lines of a pair of faces.
Margin pair_gap(const Complex& mesh, const FacePair& pair, float contact_radius);

/// Returns whether a pair of primitives without a common vertex is excluded (compare::Exclusions). Both primitives are
/// given by their vertices.
bool is_excluded(const compare::ExclusionView& exclusions, std::span<const Index> first, std::span<const Index> second);

}  // namespace ogc::reference
