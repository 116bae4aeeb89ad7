// Defines the launches whose kernels sum over a vertex's stencils. They take longest to compile, so each backend
// instantiates each sum in its own object file.
#pragma once

#include "fast/kernels/sweep/sums.hpp"
#include "fast/kernels/sweep/update_vertex.hpp"
#include "fast/stages/sweep.hpp"

namespace ogc::fast {

template <class Backend, class Sum>
void update_vertices(Backend& backend, int lanes, Teams teams, const UpdateVertex<Sum>& kernel, Start start) {
  switch (lanes) {
    case 2: return backend.template for_each_team<2>(teams, kernel, start);
    case 4: return backend.template for_each_team<4>(teams, kernel, start);
    case 8: return backend.template for_each_team<8>(teams, kernel, start);
    default: return backend.template for_each_team<16>(teams, kernel, start);
  }
}

template <class Backend>
void measure_vertices(Backend& backend, int slots, const MeasureVertex<GatherAll>& kernel) {
  backend.template for_each_team<8>(slots, kernel, Start::after_previous);
}

}  // namespace ogc::fast
