// Defines the half-spaces of vertices, as stage plane returns them and snapshots of a simulation contain them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"

namespace ogc::compare {

/// A pair of primitives that share no vertex: a vertex and a triangle, or two edges, the lower-numbered first.
struct PrimitivePair {
  enum class Kind : std::uint8_t { vertex_triangle, edge_edge };  ///< what the pair consists of
  Kind kind = Kind::vertex_triangle;  ///< whether `first` and `second` are a vertex and a triangle, or edges
  Index first = -1, second = -1;      ///< numbers of the vertex and the triangle, or of the edges
  friend bool operator==(const PrimitivePair&, const PrimitivePair&) = default;
};

/// A half-space n·x ≤ o of a vertex: one side of the plane of a pair. The vertices of the pair's first side have the
/// normal n, those of its second side −n, bit by bit; n need not be a unit vector.
struct VertexPlane {
  PrimitivePair pair;  ///< the pair that the plane separates
  Vec3f normal;        ///< n, away from the vertex's side
  double offset = 0;   ///< [m] times the length of n
};

/// Row v, items[offsets[v] … offsets[v + 1]), holds the planes of vertex v. Both arrays are empty without planes.
struct VertexPlanes {
  std::vector<Index> offsets;      ///< [vertices + 1], or empty
  std::vector<VertexPlane> items;  ///< of all vertices, one after the other

  /// Returns the planes of vertex v.
  std::span<const VertexPlane> of(Index v) const {
    if (offsets.empty()) return {};
    const auto i = static_cast<std::size_t>(v);
    return std::span(items).subspan(static_cast<std::size_t>(offsets[i]),
                                    static_cast<std::size_t>(offsets[i + 1] - offsets[i]));
  }
};

}  // namespace ogc::compare
