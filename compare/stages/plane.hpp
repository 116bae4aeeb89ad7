// Stage plane: what holds each vertex until the next detection where bounds are planes (method.md §5.6): half-spaces of
// near pairs, and a ball for all pairs that have none.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "compare/stages/detect.hpp"

namespace ogc::compare {

/// A pair of primitives that share no vertex: a vertex and a triangle, or two edges, the lower-numbered first.
struct PrimitivePair {
  enum class Kind : std::uint8_t { vertex_triangle, edge_edge };  ///< of what the pair consists
  Kind kind = Kind::vertex_triangle;                              ///< what `first` and `second` count
  Index first = -1, second = -1;  ///< numbers of the vertex and the triangle, or of the edges
  friend bool operator==(const PrimitivePair&, const PrimitivePair&) = default;
};

/// n·x ≤ o: one side of the plane of a pair, as one of its vertices bears it. The vertices of the pair's first side
/// have the normal n, those of its second −n, bit by bit; n need not be a unit vector.
struct VertexPlane {
  PrimitivePair pair;  ///< whose sides the plane holds apart
  Vec3f normal;        ///< n, away from the vertex's side
  double offset = 0;   ///< [m] times the length of n
};

/// Row v, items[offsets[v] … offsets[v + 1]), is what vertex v bears. Empty where there are no planes.
struct VertexPlanes {
  std::vector<Index> offsets;      ///< [vertices + 1], or empty
  std::vector<VertexPlane> items;  ///< of all vertices, one after the other

  /// What vertex v bears.
  std::span<const VertexPlane> of(Index v) const {
    if (offsets.empty()) return {};
    const auto i = static_cast<std::size_t>(v);
    return std::span(items).subspan(static_cast<std::size_t>(offsets[i]),
                                    static_cast<std::size_t>(offsets[i + 1] - offsets[i]));
  }
};

/// A state, and what decides which pairs count.
struct PlaneIn {
  const Topology* topology = nullptr;      ///< of the whole scene
  ExclusionView exclusions;                ///< pairs that are none
  std::span<const Vec3f> positions;        ///< X of the detection [m]
  std::span<const std::uint8_t> is_fixed;  ///< by vertex: it never moves, and bears no plane
  float query_radius = 0;                  ///< r_q [m]
  float bound_relaxation = 0.45f;          ///< γ_p
};

/// What a vertex may do until the next detection: K_v is its ball and its half-spaces (method.md §5.6).
struct PlaneOut {
  VertexPlanes planes;       ///< by vertex, ascending by pair
  std::vector<float> bound;  ///< radius of each vertex's ball [m]
};

/// The truth follows the answer. A pair is *separated* if one plane of it holds both sides: each of its vertices that
/// can move bears it and keeps it at X, and between the two offsets (of a fixed vertex: where it is) there is room.
/// Every other pair within r_q must be *covered*: b_v ≤ γ_p d for each of its vertices that can move. All is exact.
struct PlaneTruth {
  std::size_t separated = 0;  ///< pairs within r_q
  std::size_t uncovered = 0;  ///< pairs that are neither
  PrimitivePair worst;        ///< the first of these, by kind, first and second
  std::size_t broken = 0;     ///< half-spaces that their vertex does not keep at X
  std::size_t too_large = 0;  ///< vertices with b_v > γ_p r_q
  /// Whether the answer keeps the guarantee.
  bool kept() const { return uncovered == 0 && broken == 0 && too_large == 0; }
};

}  // namespace ogc::compare
