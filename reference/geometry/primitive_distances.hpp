// Computes only the smallest distances of a detection, from which bounds follow. detect_*.hpp adds contacts and grey
// zones; nearest.hpp also finds the pair that has each distance.
#pragma once

#include <vector>

#include "compare/stages/detect.hpp"

namespace ogc::reference {

/// d_min,v, d_min,e and d_min,t [m] (Alg. 1 line 6, Alg. 2; Eq. 22, 24, 26); r_q if no primitive is nearer. The values
/// are bit for bit the same as in detect_vertex_facet and detect_edge_edge.
struct PrimitiveDistances {
  std::vector<float> vertex, edge, triangle;  ///< by number of the primitive [m]
};

/// Computes the distances in parallel; the answer does not depend on the number of threads. First measures each
/// primitive's neighbours in the mesh. Then searches only up to the smallest distance found so far, at most r_q.
PrimitiveDistances primitive_distances(const compare::DetectIn& in);

/// Returns b_v of Eq. 21 [m], by vertex, rounded down. Throws only when memory runs out.
std::vector<float> exact_bounds(const compare::DetectIn& in, float bounds_relaxation);

}  // namespace ogc::reference
