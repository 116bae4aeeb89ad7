// Algorithm 1 as searches: one for each vertex, in the order of a Hilbert curve. Launched together with those of
// Algorithm 2, as neither fills a device; needs refitted trees, prepared lists and reset minima
// (fast/stages/detection.hpp).
#pragma once

#include "fast/kernels/detect_vertex_facet.hpp"

namespace ogc::fast {

/// One for each vertex; none where there is no facet.
inline Searches<DetectVertexFacet> searches_of(const DetectVertexFacet& query) {
  return {query.tree, query.tree.count > 0 ? query.surface.searched_vertices : 0, query};
}

}  // namespace ogc::fast
