// Adds the sums of a step of a scene with rods, and finds the extremes for its row.
#pragma once

#include "fast/kernels/rods/contact_distance.hpp"
#include "fast/kernels/rods/metrics.hpp"
#include "fast/kernels/sums/step_sums.hpp"

namespace ogc::fast {

/// Sums of `Others` and of rods.
template <class Others>
struct RodSums {
  Others others;
  SegmentTerm segment;
  int segments;
  ActiveDistance<VertexFacetRecord> vertex_facet;  ///< of each record; only the device knows their number
  ActiveDistance<EdgeEdgeRecord> edge_edge;        ///< of each record
  const int *vertex_facet_count, *edge_edge_count;
  StepControl* control;  ///< on the backend: extremes are written

  /// Adds the terms of one chunk.
  OGC_HD void add(int chunk, int chunks, double* sums) const {
    others.add(chunk, chunks, sums);
    float longest = 0, nearest = 3.40282347e38f;
    for (int e = chunk; e < segments; e += chunks) longest = larger(longest, segment(e, sums));
    for (int i = chunk; i < *vertex_facet_count; i += chunks) nearest = smaller(nearest, vertex_facet(i));
    for (int i = chunk; i < *edge_edge_count; i += chunks) nearest = smaller(nearest, edge_edge(i));
    raise_together(&control->longest_segment, float_bits(longest));
    lower_together(&control->nearest_contact, nearest);
  }
};

}  // namespace ogc::fast
