// Stage block: membership in the blocks of the offset's decomposition, as detections need it (Eq. 8–10, 14, 15).
#pragma once

#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// The question whether x is in U_a, apart from its distance: the distance is a decision of its own (d < r, Alg. 1 line
/// 7). It names a face a of the mesh and the point x.
struct BlockQuestion {
  /// The kind of x, and the manifold of the blocks.
  enum class Kind : std::uint8_t {
    /// x is vertex `of`; U_a of Eq. 8, 9, 10 for a vertex, edge (between its end planes too) or triangle.
    vertex_in_surface,
    /// x is the point of edge `of` closest to a; U_a of Eq. 14, 15 for an edge or vertex of the edge-only manifold. One
    /// point is closest to a vertex, and to an edge unless the two are parallel: nearly parallel edges (‖e×e'‖² <
    /// 10⁻⁶‖e‖²‖e'‖²) are no legal question of this stage (their contacts: compare/stages/detect_edge_edge.hpp).
    edge_in_edges,
  };
  Kind kind = Kind::vertex_in_surface;  ///< the kind that `of` counts
  Index of = -1;                        ///< a vertex or an edge without a common vertex with a
  Face face;                            ///< a; never a triangle if kind is edge_in_edges
  friend bool operator==(const BlockQuestion&, const BlockQuestion&) = default;
};

/// Positions are at most 2²⁰ m in modulus, however small; collapsed triangles and edges are legal.
struct BlockIn {
  const Topology* topology = nullptr;        ///< of the mesh
  std::span<const Vec3f> positions;          ///< [m], length vertex_count
  std::span<const BlockQuestion> questions;  ///< independent of each other
};

/// The answer.
struct BlockOut {
  std::vector<std::uint8_t> inside;  ///< by question; boundaries open and closed as printed
};

/// grey: a margin that decides the answer lies in its grey zone; either answer is accepted there. For edge_in_edges
/// that includes the margins that decide which point of `of` is closest.
struct BlockTruth {
  std::vector<std::uint8_t> inside, grey;  ///< exact; 1 where either answer is accepted
  std::vector<std::uint8_t> near;          ///< 1 where a margin lies within near_factor
};

}  // namespace ogc::compare
