// Refits the trees of the parts of volumes. The order of primitives in a tree never changes, because neighbours on a
// body remain neighbours while it moves.
#pragma once

#include "fast/kernels/volumes/solids.hpp"

namespace ogc::fast {

/// Computes the boxes of all facets, tetrahedra and nodes, and whether each tetrahedron has a positive volume. Runs
/// once for each index below count(); the 32 threads of a warp must call this together (RefitTrees).
struct RefitVolumes {
  SurfaceView surface;
  SolidView solids;                        ///< is_positive is written
  const Vec* positions;                    ///< by vertex [m]
  const PartTree* trees;                   ///< trees of facets, then trees of tetrahedra; their boxes are written
  int facet_trees, count_of_trees, items;  ///< `items`: indices of all trees, each tree padded to whole warps

  OGC_HD int count() const { return items; }

  OGC_HD void operator()(int i) const {
    int tree = 0;  // last tree with first_item ≤ i
    for (int end = count_of_trees; end - tree > 1;) {
      const int middle = (tree + end) / 2;
      if (trees[middle].first_item <= i)
        tree = middle;
      else
        end = middle;
    }
    const PartTree& own = trees[tree];
    if (tree < facet_trees)
      RefitTrees::place(own.tree, own.arrivals, i - own.first_item, [this](int t) { return facet_child(t); });
    else
      RefitTrees::place(own.tree, own.arrivals, i - own.first_item, [this](int t) { return element_child(t); });
  }

 private:
  OGC_HD Child facet_child(int t) const {
    Box box;
    for (const int corner : surface.facets[t].corner) box.include(positions[corner]);
    return {box.lower, 0, box.upper, t};
  }
  OGC_HD Child element_child(int t) const {
    const int* corner = solids.elements[t].corner;
    Box box;
    for (int k = 0; k < 4; ++k) box.include(positions[corner[k]]);
    solids.is_positive[t] = exact_sign(Orientation{positions[corner[0]], positions[corner[1]], positions[corner[2]],
                                                   positions[corner[3]]}) > 0
                                ? 1
                                : 0;
    return {box.lower, 0, box.upper, t};
  }
};

}  // namespace ogc::fast
