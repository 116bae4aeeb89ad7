// Makes the searches of Algorithm 1, one for each vertex, in the order of a Hilbert curve. They share a launch with the
// searches of Algorithm 2, since neither algorithm fills a device. They need refitted trees, prepared lists and reset
// minima (fast/stages/detection.hpp).
#pragma once

#include "fast/kernels/detect_vertex_facet.hpp"

namespace ogc::fast {

/// Returns one search for each vertex; none if there is no facet.
inline Searches<DetectVertexFacet> searches_of(const DetectVertexFacet& query) {
  return {query.tree, query.tree.count > 0 ? query.surface.searched_vertices : 0, query};
}

}  // namespace ogc::fast
