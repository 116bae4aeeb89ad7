// Stage block: membership in the blocks of the offset's decomposition, as the detections ask it (Eq. 8–10, 14, 15).
#pragma once

#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// "Is x in U_a, apart from its distance?": the distance is a decision of its own (d < r, Alg. 1 line 7). A question names a face of the mesh and what x is.
struct BlockQuestion {
  enum class Kind : std::uint8_t {
    vertex_in_surface,  ///< x is vertex `of`; U_a of Eq. 8, 9, 10 for a vertex, edge or triangle
    edge_in_edges,      ///< x is the point of edge `of` closest to a; U_a of Eq. 14, 15 for an edge or vertex of the edge-only manifold
  };
  Kind kind = Kind::vertex_in_surface;
  Index of = -1;  ///< a vertex, or an edge, that has no vertex in common with a
  Face face;      ///< a
  friend bool operator==(const BlockQuestion&, const BlockQuestion&) = default;
};

struct BlockIn {
  const Topology* topology = nullptr;
  std::span<const Vec3f> positions;  ///< [m], length vertex_count
  std::span<const BlockQuestion> questions;
};

struct BlockOut {
  std::vector<std::uint8_t> inside;  ///< by question; boundaries open and closed as printed
};

/// grey: a margin that decides the answer lies in its grey zone; either answer is accepted there.
struct BlockTruth {
  std::vector<std::uint8_t> inside, grey;
};

}  // namespace ogc::compare
