// Launch of Algorithm 2: one thread an edge, in tree order. Same needs as detect_vertex_facet.hpp.
#pragma once

#include "fast/kernels/detect_edge_edge.hpp"

namespace ogc::fast {

template <class Backend>
void detect_edge_edge(Backend& backend, const DetectEdgeEdge& kernel) {
  backend.for_each(kernel.surface.edge_count, kernel);
}

}  // namespace ogc::fast
