// The second half of both detections: of the pairs that the searches noted, those that are contacts, one thread a pair.
#pragma once

#include "fast/kernels/detect_edge_edge.hpp"
#include "fast/kernels/detect_vertex_facet.hpp"

namespace ogc::fast {

/// Index over the noted pairs.
struct CollectContacts {
  static constexpr int resident_blocks = 4;  ///< 128 registers; 6 spill more than more warps win (fast/PERFORMANCE.md)
  CollectVertexFacet vertex_facet;
  CollectEdgeEdge edge_edge;

  OGC_HD void operator()(int i) const {
    const ListsView& lists = vertex_facet.lists;
    if (*lists.overflow != 0) return;
    const NotedPair pair = lists.noted[i];
    const bool certain = pair.second < 0;
    const int second = certain ? ~pair.second : pair.second;
    if (pair.first < 0) {
      vertex_facet(~pair.first, second, certain);
    } else {
      edge_edge(pair.first, second, certain);
    }
  }
};

}  // namespace ogc::fast
