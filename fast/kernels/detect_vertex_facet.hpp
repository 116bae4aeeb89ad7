// Algorithm 1 for one vertex. Each pair's smallest distance also counts the gap of the boxes (never above the exact distance either): then a pair whose
// gap reaches the minima found so far cannot lower them by one bit, and may be skipped whatever the order in which threads find each other's minima.
#pragma once

#include "fast/kernels/atomic.hpp"
#include "fast/kernels/block.hpp"
#include "fast/kernels/bvh.hpp"
#include "fast/kernels/closest_face.hpp"
#include "fast/kernels/lists.hpp"

namespace ogc::fast {

struct DetectVertexFacet {
  SurfaceView surface;
  const Vec* positions;
  TreeView tree;
  const int* vertex_order;
  ListsView lists;
  float contact_radius;
  const float* query_radius;
  float* d_min_vertex;    ///< at most r_q; only this kernel's thread of the vertex writes it
  float* d_min_triangle;  ///< at most r_q before the launch

  OGC_HD void operator()(int i) const {
    if (*lists.overflow != 0) return;
    const int v = vertex_order[i];
    const Vec x = positions[v];
    float smallest = *query_radius, limit = gap_limit(larger(contact_radius, Reach{surface, positions, query_radius}.of_vertex(v)));
    for_each_near(tree, {x, x}, 0, limit, [&](int place, float gap) { visit(v, x, tree.order[place], gap, smallest, limit); });
    d_min_vertex[v] = smallest;
  }

 private:
  OGC_HD void visit(int v, const Vec& x, int t, float gap, float& smallest, float& limit) const {
    if (gap > limit && gap > gap_limit(atomic_load(&d_min_triangle[t]))) return;
    const Facet facet = surface.facets[t];
    if (facet.corner[0] == v || facet.corner[1] == v || facet.corner[2] == v || surface.in_one_group(v, facet)) return;
    const Corners corners{positions[facet.corner[0]], positions[facet.corner[1]], positions[facet.corner[2]]};
    const Distance d = point_triangle_distance(x, corners);
    const float below = larger(d.below(), gap_below(gap));
    smallest = smaller(smallest, below);
    limit = smaller(limit, gap_limit(larger(contact_radius, smallest)));
    if (below < atomic_load(&d_min_triangle[t])) atomic_min(&d_min_triangle[t], below);
    if (sub(d.value, d.slack) < static_cast<double>(contact_radius)) collect(v, x, t, facet, corners, d);
  }

  /// Each triangle around a shared face reports it; the lists keep one.
  OGC_HD void collect(int v, const Vec& x, int t, const Facet& facet, const Corners& corners, const Distance& d) const {
    const TriangleFeature feature = closest_feature(x, corners, facet.descending);
    if (!is_within(x, corners, feature, d, contact_radius)) return;
    if (feature == TriangleFeature::interior) {
      lists.append({v, surface.triangle_face(t), 0, 0});
    } else if (feature <= TriangleFeature::corner_2) {
      const int a = facet.corner[static_cast<int>(feature)];
      if (in_vertex_block(x, a, surface, positions)) lists.append({v, surface.vertex_face(a), 0, 0});
    } else {
      const int e = facet.edge[static_cast<int>(feature) - static_cast<int>(TriangleFeature::edge_01)];
      if (in_edge_block(x, e, surface, positions)) lists.append({v, surface.edge_face(e), 0, 0});
    }
  }
};

}  // namespace ogc::fast
