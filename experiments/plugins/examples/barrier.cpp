// A correct plug-in in double precision for the stage barrier: IPC's barrier over the squared distance with a
// thickness, its slope and its curvature.
//
//     g++ -O2 -shared -fPIC -I INCLUDE barrier.cpp -o barrier.so
//     ogc compare barrier --plugin ./barrier.so
#include <cmath>

#include "compare/plugin.h"

OGC_PLUGIN("barrier in double", OGC_HOST_MEMORY)

int ogc_barrier(const ogc_barrier_in* in, ogc_barrier_out* out) {
  for (int64_t i = 0; i < in->n; ++i) {
    const double xi = in->thickness[i], reach = in->activation_distance[i];
    const double gap = in->squared_distance[i] - xi * xi, most = reach * (reach + 2 * xi), below = gap - most;
    out->energy[i] = out->slope[i] = out->curvature[i] = 0;
    if (!(below < 0)) continue;
    const double log = 2 * gap < most ? std::log(gap / most) : std::log1p(below / most), share = below / gap;
    out->energy[i] = float(-below * below * log);
    out->slope[i] = float(-below * (2 * log + share));
    out->curvature[i] = float(-2 * log - share * (4 - share));
  }
  return 0;
}
