// Stage block: membership in the blocks of the offset's decomposition, as the detections ask it (Eq. 8–10, 14, 15).
#pragma once

#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// "Is x in U_a, apart from its distance?": the distance is a decision of its own (d < r, Alg. 1 line 7). A question
/// names a face of the mesh and what x is.
struct BlockQuestion {
  /// What x is, and of which manifold the blocks are.
  enum class Kind : std::uint8_t {
    /// x is vertex `of`; U_a of Eq. 8, 9, 10 for a vertex, edge (between its end planes too) or triangle.
    vertex_in_surface,
    /// x is the point of edge `of` closest to a; U_a of Eq. 14, 15 for an edge or vertex of the edge-only manifold. To
    /// a vertex one point is closest. To an edge it is one unless the two are parallel: nearly parallel ones (‖e×e'‖² <
    /// 10⁻⁶‖e‖²‖e'‖²) are no legal question of this stage (their contacts: compare/stages/detect_edge_edge.hpp).
    edge_in_edges,
  };
  Kind kind = Kind::vertex_in_surface;  ///< what `of` counts
  Index of = -1;                        ///< a vertex, or an edge, that has no vertex in common with a
  Face face;                            ///< a; no triangle where kind is edge_in_edges
  friend bool operator==(const BlockQuestion&, const BlockQuestion&) = default;
};

/// Positions are at most 2²⁰ m in modulus, however small; collapsed triangles and edges are legal.
struct BlockIn {
  const Topology* topology = nullptr;        ///< of the mesh
  std::span<const Vec3f> positions;          ///< [m], length vertex_count
  std::span<const BlockQuestion> questions;  ///< each by itself
};

/// The answer.
struct BlockOut {
  std::vector<std::uint8_t> inside;  ///< by question; boundaries open and closed as printed
};

/// grey: a margin that decides the answer lies in its grey zone; either answer is accepted there. For an edge in edges
/// that includes the margins that say which point of `of` is closest.
struct BlockTruth {
  std::vector<std::uint8_t> inside, grey;  ///< exact; 1 where either answer is accepted
  std::vector<std::uint8_t> near;          ///< 1 where such a margin lies within near_factor
};

}  // namespace ogc::compare
