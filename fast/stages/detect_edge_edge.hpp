// Makes the searches of Algorithm 2, one for each edge, in tree order (see detect_vertex_facet.hpp).
#pragma once

#include "fast/kernels/detect_edge_edge.hpp"

namespace ogc::fast {

/// Returns one search for each edge.
inline Searches<DetectEdgeEdge> searches_of(const DetectEdgeEdge& query) {
  return {query.tree, query.surface.searched_edges, query};
}

}  // namespace ogc::fast
