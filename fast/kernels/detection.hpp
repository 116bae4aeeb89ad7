// The launches of a detection that are neither a search nor a list's own: what every later one starts from, and the
// look at pairs of a Verlet list in place of a search (skin.hpp). Launches that stand beside each other are one
// functor.
#pragma once

#include "fast/kernels/bound.hpp"
#include "fast/kernels/bvh.hpp"
#include "fast/kernels/detect_edge_edge.hpp"
#include "fast/kernels/detect_vertex_facet.hpp"
#include "fast/kernels/lists.hpp"

namespace ogc::fast {

/// Positions where they are gathered, empty lists, smallest distances at r_q. Index over the largest of buckets,
/// vertices and primitives.
struct PrepareDetection {
  const Vec* positions;  ///< by vertex [m]
  PaddedVec* padded;     ///< the same positions, written, where searches gather them
  PrepareLists lists;
  ResetDistances distances;

  OGC_HD void operator()(int i) const {
    if (i < distances.vertex_count) padded[i] = PaddedVec(positions[i]);
    lists(i);
    distances(i);
  }
};

/// Both at once, where no skin decides in between whether the trees are needed; whole warps of 32.
struct PrepareAndRefit {
  PrepareDetection prepare;
  RefitTrees refit;

  OGC_HD void operator()(int i) const {
    prepare(i);
    refit(i);
  }
};

/// The pairs of the Verlet list, in place of a search; index over all of them.
struct RecheckPairs {
  /// Their `recheck` measures the pairs of a vertex and a facet, and those of two edges.
  DetectVertexFacet vertex_facet;
  DetectEdgeEdge edge_edge;

  OGC_HD void operator()(int i) const {
    const SkinView& skin = edge_edge.skin;
    if (*edge_edge.lists.overflow != 0 || !skin.rechecks()) return;
    const NotedPair pair = skin.pairs[i];
    if (pair.first < 0) {
      vertex_facet.recheck(~pair.first, pair.second);
    } else {
      edge_edge.recheck(pair.first, pair.second);
    }
  }
};

}  // namespace ogc::fast
