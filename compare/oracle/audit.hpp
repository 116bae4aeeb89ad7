// The oracle: exact intersection audit of a state, by CGAL, of any contestant or of none (method.md §5.5).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "compare/problem/element_names.hpp"
#include "compare/problem/exclusions.hpp"

namespace ogc::compare {

enum class IntersectionKind : std::uint8_t { edge_triangle, vertex_triangle, edge_edge };  ///< what meets

/// Edge `first` meets triangle `second` (touching counts) without sharing a vertex, vertex `first` lies on triangle
/// `second` that does not contain it, or edges `first` < `second` meet, of which the triangles say nothing: both are of
/// no triangle, or one meets the side of a triangle that lies opposite to their common vertex. Two edges with a common
/// vertex meet where the other end of one lies on the other.
struct Intersection {
  IntersectionKind kind = IntersectionKind::edge_triangle;  ///< which faces meet
  Index first = -1, second = -1;                            ///< edge or vertex, triangle or edge
  friend auto operator<=>(const Intersection&, const Intersection&) = default;
};

/// How much of its findings an audit lists.
struct AuditOptions {
  std::size_t limit = 1000;  ///< list at most so many; the count goes on
};

/// What an audit found.
struct AuditResult {
  std::vector<Intersection> intersections;  ///< ascending
  std::size_t count = 0;                    ///< of all intersections
  std::size_t pairs_tested = 0;  ///< of edges with triangles and with edges whose boxes meet, but those left out
};

/// Exact: no rounding decides, and the answer does not depend on the number of threads. Two primitives with common
/// vertices intersect where they meet beyond the face that these span (method.md §5.5). `exclusions`: pairs that are
/// left out. A collapsed triangle is the segment or point that it covers, an edge of
/// length zero a point. Isolated vertices belong to no surface and are left out. A vertex on a triangle is listed
/// beside its edges, which touch the triangle too. That curves touch nowhere says nothing of the way to this state
/// (compare/oracle/meetings.hpp). Throws InputError where a position is not finite or sizes do not
/// fit.
AuditResult audit(const Topology& topology, std::span<const Vec3> positions, const ExclusionView& exclusions = {},
                  const AuditOptions& options = {});

/// Of the listed intersections each vertex of the one face with each of the other, the smaller first, ascending: who
/// excludes these pairs (Scene::excluded_pairs) leaves out what meets, and whatever else has both of such a pair.
std::vector<Edge> vertex_pairs(const AuditResult& result, const Topology& topology);

/// "edge of body 'cloth' (vertices 3, 7) meets face 40 of body 'floor' (…)".
std::string describe(const Intersection& pair, const Topology& topology, const ElementNames& names = {});
/// One line for each that is listed, and how many more there are.
std::string describe(const AuditResult& result, const Topology& topology, const ElementNames& names = {});

}  // namespace ogc::compare
