// Algorithm 2 for one edge, each pair once: the edge at place i of the tree order looks at the places behind its own only, and both
// partners take the distance. Pairs are skipped as in detect_vertex_facet.hpp.
#pragma once

#include "fast/kernels/atomic.hpp"
#include "fast/kernels/block.hpp"
#include "fast/kernels/bvh.hpp"
#include "fast/kernels/closest_points.hpp"
#include "fast/kernels/lists.hpp"

namespace ogc::fast {

struct DetectEdgeEdge {
  SurfaceView surface;
  const Vec* positions;
  TreeView tree;
  ListsView lists;
  float contact_radius;
  const float* query_radius;
  float* d_min_edge;  ///< at most r_q before the launch

  OGC_HD void operator()(int i) const {
    if (*lists.overflow != 0) return;
    const int e = tree.order[i];
    const Quad& leaf = tree.node(0, i / 4);
    float smallest = atomic_load(&d_min_edge[e]), limit = larger(gap_limit(contact_radius), leaf.reach[i % 4]);
    for_each_near(tree, leaf.box(i % 4), i + 1, limit, [&](int place, float gap) { visit(e, tree.order[place], gap, smallest, limit); });
    atomic_min(&d_min_edge[e], smallest);
  }

 private:
  OGC_HD Ends ends(const EdgeEnds& e) const { return {positions[e.a], positions[e.b]}; }

  OGC_HD void visit(int e, int other, float gap, float& smallest, float& limit) const {
    if (gap > limit && gap > gap_limit(atomic_load(&d_min_edge[other]))) return;
    const int low = e < other ? e : other, high = e < other ? other : e;
    const EdgeEnds p = surface.edges[low], q = surface.edges[high];
    if (p.a == q.a || p.a == q.b || p.b == q.a || p.b == q.b || surface.in_one_group(p, q)) return;
    const Distance d = edge_edge_distance(ends(p), ends(q));
    const float below = larger(d.below(), gap_below(gap));
    smallest = smaller(smallest, below);
    limit = smaller(limit, gap_limit(larger(contact_radius, smallest)));
    if (below < atomic_load(&d_min_edge[other])) atomic_min(&d_min_edge[other], below);
    if (sub(d.value, d.slack) < static_cast<double>(contact_radius)) collect(low, high, p, q, d);
  }

  OGC_HD void collect(int low, int high, const EdgeEnds& p, const EdgeEnds& q, const Distance& d) const {
    const Ends first = ends(p), second = ends(q);
    const EdgePairFeatures on = closest_edge_features(first, second);
    if (!is_within(first, second, on, d, contact_radius)) return;
    if (is_overlapping_parallel(first, second)) {
      append(surface.edge_face(low), surface.edge_face(high), low, high);
      return;
    }
    const bool is_first_inside = on.first == EdgeFeature::interior, is_second_inside = on.second == EdgeFeature::interior;
    const int v = on.first == EdgeFeature::end_0 ? p.a : p.b, w = on.second == EdgeFeature::end_0 ? q.a : q.b;
    if (!is_first_inside && !is_end_hit(v, is_second_inside, w, q)) return;
    if (!is_second_inside && !is_end_hit(w, is_first_inside, v, p)) return;
    append(is_first_inside ? surface.edge_face(low) : v, is_second_inside ? surface.edge_face(high) : w, low, high);
  }

  /// The closest point on the other edge, inside it or its end w, lies in the block of v (Eq. 15).
  OGC_HD bool is_end_hit(int v, bool is_other_inside, int w, const EdgeEnds& other) const {
    return is_other_inside ? in_vertex_block(other, v, surface, positions) : in_vertex_block(positions[w], v, surface, positions);
  }

  OGC_HD void append(int p, int q, int low, int high) const {
    const int first = p < q ? p : q, second = p < q ? q : p;
    lists.append({surface.vertex_count + first, second, low, high});
  }
};

}  // namespace ogc::fast
