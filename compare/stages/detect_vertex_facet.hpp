// Stage detect_vertex_facet: F_OGC(v) of every vertex, and the smallest distances d_min,v and d_min,t (Alg. 1, Eq. 12,
// 22, 26).
#pragma once

#include <vector>

#include "compare/stages/detect.hpp"

namespace ogc::compare {

/// A contact of v with face a: x_v ∈ U_a and d < r. `owner` is the lowest-numbered triangle that contains the face.
struct VertexFacetContact {
  Index vertex = -1;  ///< v
  Face face;          ///< the face that v touches
  Index owner = -1;   ///< triangle whose list holds the contact
  friend auto operator<=>(const VertexFacetContact&, const VertexFacetContact&) = default;
};

/// The answer. The canonical order of contacts is by vertex, then face. V_OGC(t) is the same list by owner.
struct DetectVertexFacetOut {
  std::vector<VertexFacetContact> contacts;  ///< in any order
  std::vector<float> d_min_vertex;    ///< min over non-adjacent triangles, at most r_q [m], never above the exact value
  std::vector<float> d_min_triangle;  ///< min over non-adjacent vertices, at most r_q [m], never above the exact value
};

/// The exact answer and each grey decision. Contacts are decided without rounding, smallest distances are rounded down
/// to single precision.
struct DetectVertexFacetTruth {
  DetectVertexFacetOut exact;                          ///< in canonical order, distances rounded down
  std::vector<GreyDecision<VertexFacetContact>> grey;  ///< all grey decisions
  std::size_t pairs = 0;  ///< candidate pairs within r_q, the denominator of the grey share
  std::size_t near = 0;   ///< number of vertices with a decision within near_factor
};

}  // namespace ogc::compare
