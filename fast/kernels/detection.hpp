// Runs the first launch of a detection, which prepares all that its searches start from.
#pragma once

#include "fast/kernels/bound.hpp"
#include "fast/kernels/bvh.hpp"
#include "fast/kernels/detect_edge_edge.hpp"
#include "fast/kernels/detect_vertex_facet.hpp"
#include "fast/kernels/lists.hpp"

namespace ogc::fast {

/// Copies positions to where searches gather them, empties the lists, sets smallest distances to r_q and refits the
/// boxes of the trees. No part reads what another writes. Index over count(), by whole warps.
struct BeginDetection {
  const Vec* positions;  ///< by vertex [m]
  PaddedVec* padded;     ///< the same positions, aligned, written
  PrepareLists lists;
  ResetDistances distances;
  RefitTrees refit;

  /// Returns the largest of buckets, vertices, primitives and places of the trees.
  OGC_HD int count() const {
    const int buckets = lists.lists.buckets, triangles = distances.triangle_count;
    const int items = buckets > triangles ? buckets : triangles, places = refit.count();
    return RefitTrees::filled_up(items > places ? items : places);
  }
  OGC_HD void operator()(int i) const {
    if (i < distances.vertex_count) padded[i] = PaddedVec(positions[i]);
    lists(i);
    distances(i);
    refit(i);
  }
};

}  // namespace ogc::fast
