// The trees of the parts of volumes, brought up to date. Their order stands: neighbours on a body stay neighbours,
// however it moves.
#pragma once

#include "fast/kernels/volume_depth.hpp"

namespace ogc::fast {

/// Boxes of all facets and of the nodes above them. For for_each over count() items, which a warp of 32 must call
/// together (RefitTrees).
struct RefitVolumes {
  SurfaceView surface;
  const Vec* positions;     ///< by vertex [m]
  const VolumePart* parts;  ///< by part; the boxes of their trees are written
  int part_count, items;    ///< `items`: places of all parts, each part filled up to whole warps

  OGC_HD int count() const { return items; }

  OGC_HD void operator()(int i) const {
    int part = 0;  // the last one that begins at i or before
    for (int end = part_count; end - part > 1;) {
      const int middle = (part + end) / 2;
      if (parts[middle].first_item <= i)
        part = middle;
      else
        end = middle;
    }
    RefitTrees::place(parts[part].tree, parts[part].arrivals, i - parts[part].first_item,
                      [this](int t) { return child_of(t); });
  }

 private:
  OGC_HD Child child_of(int t) const {
    Box box;
    for (const int corner : surface.facets[t].corner) box.include(positions[corner]);
    return {box.lower, 0, box.upper, t};
  }
};

}  // namespace ogc::fast
