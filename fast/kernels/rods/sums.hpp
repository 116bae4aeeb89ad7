// What a step of a scene with rods adds to its sums, and the extremes of its row, which are found beside them.
#pragma once

#include "fast/kernels/rods/contact_distance.hpp"
#include "fast/kernels/rods/metrics.hpp"
#include "fast/kernels/step_sums.hpp"

namespace ogc::fast {

/// `Others`: the sums of everything else.
template <class Others>
struct RodSums {
  Others others;
  SegmentTerm segment;
  int segments;
  ActiveDistance<VertexFacetRecord> vertex_facet;  ///< of as many records as only the device knows
  ActiveDistance<EdgeEdgeRecord> edge_edge;        ///< likewise
  const int *vertex_facet_count, *edge_edge_count;
  StepControl* control;  ///< on the backend: extremes are written

  /// Those of one chunk.
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
