// Adds up the sums of a step of a scene with rods, and finds the longest segment and the smallest contact distance.
#pragma once

#include "fast/kernels/rods/contact_distance.hpp"
#include "fast/kernels/rods/metrics.hpp"
#include "fast/kernels/sums/step_sums.hpp"

namespace ogc::fast {

/// Sums all that `Others` sums, and the energy and stretch of rods.
template <class Others>
struct RodSums {
  Others others;
  SegmentTerm segment;
  int segments;
  ActiveDistance<VertexFacetRecord> vertex_facet;  ///< distance by record; only the device knows the number of records
  ActiveDistance<EdgeEdgeRecord> edge_edge;        ///< distance by record
  const int *vertex_facet_count, *edge_edge_count;
  StepControl* control;  ///< on the backend: longest_segment and nearest_contact are written

  /// Adds the terms i = chunk, chunk + chunks, … of each sum.
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
