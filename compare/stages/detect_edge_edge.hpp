// Stage detect_edge_edge: the set E_OGC of unordered pairs of faces of the edge-only manifold, and d_min,e (Alg. 2, Eq.
// 17, 24; method.md §1.2 to §1.4).
#pragma once

#include <vector>

#include "compare/stages/detect.hpp"

namespace ogc::compare {

/// Nearly parallel edges that overlap (compare/stages/closest_points.hpp) are a contact of their interiors if they are
/// nearer than r and their closest points lie in each other's blocks. For exactly parallel edges it suffices that the
/// closest points at one of the overlap's ends do so. Two edges without triangles are a contact if they are nearer than
/// r, whatever the blocks.
///
/// A contact is an unordered pair {p, q}, each a vertex or the interior of an edge, first < second as faces.
/// `first_edge` contains `first`, and `second_edge` contains `second`. If several pairs of edges generate the contact,
/// the pair with the lexicographically smallest (lower number, higher number) is stored.
struct EdgeEdgeContact {
  Face first, second;                       ///< each a vertex or an edge, the lower face first
  Index first_edge = -1, second_edge = -1;  ///< edges that generate the pair, in the order of the faces
  friend auto operator<=>(const EdgeEdgeContact&, const EdgeEdgeContact&) = default;
};

/// The answer. The canonical order of contacts is by (first, second).
struct DetectEdgeEdgeOut {
  std::vector<EdgeEdgeContact> contacts;  ///< in any order
  /// By edge: smallest distance from an edge that shares no vertex with it, at most r_q [m], never above the exact
  /// value
  std::vector<float> d_min_edge;
};

/// The exact answer and each grey decision.
struct DetectEdgeEdgeTruth {
  DetectEdgeEdgeOut exact;                          ///< in canonical order, distances rounded down
  std::vector<GreyDecision<EdgeEdgeContact>> grey;  ///< all grey decisions
  std::size_t pairs = 0;                            ///< candidate pairs within r_q, the denominator of the grey share
  std::size_t near = 0;                             ///< number of edges with a decision within near_factor
};

}  // namespace ogc::compare
