// Launch of Algorithm 1: one thread a vertex, in Morton order, so that neighbours walk the same nodes. Needs refitted trees, prepared lists and reset
// minima (fast/stages/detection.hpp).
#pragma once

#include "fast/kernels/detect_vertex_facet.hpp"

namespace ogc::fast {

template <class Backend>
void detect_vertex_facet(Backend& backend, const DetectVertexFacet& kernel) {
  backend.for_each(kernel.surface.vertex_count, kernel);
}

}  // namespace ogc::fast
