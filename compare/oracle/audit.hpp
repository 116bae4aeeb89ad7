// The oracle audits a state for intersections exactly, with CGAL, of any contestant or of none (method.md §5.5).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "compare/problem/element_names.hpp"
#include "compare/problem/exclusions.hpp"

namespace ogc::compare {

enum class IntersectionKind : std::uint8_t { edge_triangle, vertex_triangle, edge_edge };  ///< kinds of faces that meet

/// Edge `first` meets triangle `second` (touching counts) without sharing a vertex; or vertex `first` lies on triangle
/// `second` that does not contain it; or edges `first` < `second` meet in a way that no edge and triangle show: neither
/// belongs to a triangle, or one meets the side of a triangle that lies opposite to their common vertex. Two edges with
/// a common vertex meet if the other end of one lies on the other.
struct Intersection {
  IntersectionKind kind = IntersectionKind::edge_triangle;  ///< kind of the faces
  Index first = -1, second = -1;                            ///< edge or vertex, triangle or edge
  friend auto operator<=>(const Intersection&, const Intersection&) = default;
};

/// Limits how much an audit lists.
struct AuditOptions {
  std::size_t limit = 1000;  ///< list at most so many; counting continues
};

/// The findings of an audit.
struct AuditResult {
  std::vector<Intersection> intersections;  ///< ascending
  std::size_t count = 0;                    ///< number of all intersections
  /// pairs of edges with triangles and with edges whose boxes meet, without excluded ones
  std::size_t pairs_tested = 0;
};

/// Audits a state exactly: no rounding decides, and the answer does not depend on the number of threads. Two primitives
/// with common vertices intersect if they meet beyond the face that these span (method.md §5.5). `exclusions`: excluded
/// pairs. A collapsed triangle is the segment or point that it covers, an edge of length zero is a point. Isolated
/// vertices belong to no surface and are left out. A vertex on a triangle is listed in addition to its edges, which
/// also touch the triangle. If curves touch nowhere in this state, the way to it is still unproven
/// (compare/oracle/meetings.hpp). Throws InputError if a position is not finite or sizes do not fit.
AuditResult audit(const Topology& topology, std::span<const Vec3> positions, const ExclusionView& exclusions = {},
                  const AuditOptions& options = {});

/// Returns for each listed intersection the pairs of a vertex of one face and a vertex of the other, the smaller first,
/// ascending. Excluding these pairs (Scene::excluded_pairs) leaves out the faces that meet, and all others that have
/// both vertices of a pair.
std::vector<Edge> vertex_pairs(const AuditResult& result, const Topology& topology);

/// Returns "edge of body 'cloth' (vertices 3, 7) meets face 40 of body 'floor' (…)".
std::string describe(const Intersection& pair, const Topology& topology, const ElementNames& names = {});
/// Returns one line for each listed intersection, and how many more there are.
std::string describe(const AuditResult& result, const Topology& topology, const ElementNames& names = {});

}  // namespace ogc::compare
