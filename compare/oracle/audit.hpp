// Audits a state for intersections exactly, with CGAL; the state may come from any solver or from a file (method.md
// §5.5).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "compare/problem/element_names.hpp"
#include "compare/problem/exclusions.hpp"

namespace ogc::compare {

enum class IntersectionKind : std::uint8_t { edge_triangle, vertex_triangle, edge_edge };  ///< kinds of faces that meet

/// One intersection, of one of three kinds:
///
/// - Edge `first` meets triangle `second` without sharing a vertex; touching counts.
/// - Vertex `first` lies on triangle `second`, of which it is no corner.
/// - Edges `first` < `second` meet, and neither edge meets a triangle of the other edge as in the first kind. There are
///   two cases:
///   - Both edges belong to no triangle. If they share a vertex, the other end of one edge lies on the other edge.
///   - One edge shares a vertex with a triangle, and the other is this triangle's edge opposite to that vertex.
struct Intersection {
  IntersectionKind kind = IntersectionKind::edge_triangle;  ///< kind of the faces
  Index first = -1, second = -1;                            ///< an edge or a vertex; a triangle or an edge
  friend auto operator<=>(const Intersection&, const Intersection&) = default;
};

/// Limits how much an audit lists.
struct AuditOptions {
  std::size_t limit = 1000;  ///< most intersections in the list; counting continues
};

/// The findings of an audit.
struct AuditResult {
  std::vector<Intersection> intersections;  ///< ascending
  std::size_t count = 0;                    ///< number of all intersections
  /// pairs of an edge and a triangle, or of two edges, whose boxes meet; excluded pairs do not count
  std::size_t pairs_tested = 0;
};

/// Audits a state exactly: the answer depends neither on rounding nor on the number of threads. Two primitives with
/// common vertices intersect if they meet outside of the face that these vertices span (method.md §5.5). A collapsed
/// triangle is the segment or point that it covers; an edge of length zero is a point. Isolated vertices belong to no
/// surface and are left out. A vertex on a triangle is listed in addition to its edges, which also touch the triangle.
/// An audit of states does not prove the motion between them (compare/oracle/meetings.hpp). Throws InputError if a
/// position is not finite or sizes do not match.
AuditResult audit(const Topology& topology, std::span<const Vec3> positions, const ExclusionView& exclusions = {},
                  const AuditOptions& options = {});

/// Returns pairs of vertices of different faces: for each listed intersection, all pairs of one vertex of each face.
/// Pairs are in ascending order, each with the smaller vertex first. If a scene has these pairs in
/// Scene::excluded_pairs, audits skip two faces if one contains the first vertex of a pair and the other contains the
/// second vertex.
std::vector<Edge> vertex_pairs(const AuditResult& result, const Topology& topology);

/// Returns "edge of body 'cloth' (vertices 3, 7) meets face 40 of body 'floor' (…)".
std::string describe(const Intersection& pair, const Topology& topology, const ElementNames& names = {});
/// Returns one line for each listed intersection, then a line with the number of further ones.
std::string describe(const AuditResult& result, const Topology& topology, const ElementNames& names = {});

}  // namespace ogc::compare
