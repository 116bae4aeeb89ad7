// Prepares the data that the searches of a detection read, in the first launch of the detection.
#pragma once

#include "fast/kernels/bound.hpp"
#include "fast/kernels/bvh.hpp"
#include "fast/kernels/detect_edge_edge.hpp"
#include "fast/kernels/detect_vertex_facet.hpp"
#include "fast/kernels/lists.hpp"
#include "fast/kernels/plane_lists.hpp"

namespace ogc::fast {

/// Copies positions into aligned vectors, clears the lists, sets smallest distances to r_q, prepares planes, and refits
/// the trees. The five operations are independent of each other. Runs once for each index below count(), in whole
/// warps.
struct BeginDetection {
  const Vec* positions;  ///< by vertex [m]
  PaddedVec* padded;     ///< the same positions in aligned vectors, written
  PrepareLists lists;
  ResetDistances distances;
  PreparePlanes planes;
  RefitTrees refit;

  /// Returns the number of items of the launch: enough for all buckets, all triangles and all places of the trees, in
  /// whole warps.
  OGC_HD int count() const {
    const int buckets = lists.lists.buckets, triangles = distances.triangle_count;
    const int items = buckets > triangles ? buckets : triangles, places = refit.count();
    return RefitTrees::filled_up(items > places ? items : places);
  }
  OGC_HD void operator()(int i) const {
    if (i < distances.vertex_count) {
      padded[i] = PaddedVec(positions[i]);
      planes(i);
    }
    lists(i);
    distances(i);
    refit(i);
  }
};

}  // namespace ogc::fast
