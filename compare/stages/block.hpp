// Stage block: whether a point lies in a block of the offset's decomposition, as detections need it (Eq. 8–10, 14, 15).
#pragma once

#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// One case: whether the point x lies in the block U_a of face a, however far from a. The test whether x is near
/// enough, d < r (Alg. 1 line 7), is not part of this stage.
struct BlockQuestion {
  /// What x is, and the manifold that is divided into blocks.
  enum class Kind : std::uint8_t {
    /// x is the vertex with index `of`. U_a is the block of Eq. 8 if a is a vertex, of Eq. 9 with its end planes if a
    /// is an edge, of Eq. 10 if a is a triangle.
    vertex_in_surface,
    /// x is the point closest to a on the edge with index `of`. a is an edge or vertex of the edge-only manifold, and
    /// U_a is its block of Eq. 14 or 15. x is unique unless a is a parallel edge. So nearly parallel edges (‖e×e'‖² <
    /// 10⁻⁶‖e‖²‖e'‖²) are illegal here; compare/stages/detect_edge_edge.hpp defines their contacts.
    edge_in_edges,
  };
  Kind kind = Kind::vertex_in_surface;  ///< whether `of` is the index of a vertex or of an edge
  Index of = -1;                        ///< a vertex or an edge that shares no vertex with a
  Face face;                            ///< a; never a triangle if kind is edge_in_edges
  friend bool operator==(const BlockQuestion&, const BlockQuestion&) = default;
};

/// The moduli of the coordinates are at most 2²⁰ m and may be arbitrarily small. Collapsed triangles and edges are
/// legal.
struct BlockIn {
  const Topology* topology = nullptr;        ///< of the mesh
  std::span<const Vec3f> positions;          ///< [m], length vertex_count
  std::span<const BlockQuestion> questions;  ///< independent of each other
};

/// The answer.
struct BlockOut {
  std::vector<std::uint8_t> inside;  ///< by question; boundaries are open or closed as the paper prints them
};

/// The exact answers. An answer is grey if a margin that decides it lies in its grey zone; then 0 and 1 are accepted.
/// For edge_in_edges, margins that decide which point of edge `of` is closest to a count as well.
struct BlockTruth {
  std::vector<std::uint8_t> inside, grey;  ///< exact; 1 where either answer is accepted
  std::vector<std::uint8_t> near;          ///< 1 where a margin lies within near_factor
};

}  // namespace ogc::compare
