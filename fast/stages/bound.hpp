// Launch of the bounds (Eq. 21): one thread a vertex.
#pragma once

#include "fast/kernels/bound.hpp"

namespace ogc::fast {

template <class Backend>
void compute_bounds(Backend& backend, int vertex_count, const ConservativeBound& kernel) {
  backend.for_each(vertex_count, kernel);
}

}  // namespace ogc::fast
