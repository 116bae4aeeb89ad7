// Holds two trees, over facets and over edges, and an order of the vertices. A refit is one launch. A rebuild first
// refits in the old order, because Hilbert keys need the extent of the mesh, which the roots' boxes give. Then one sort
// orders vertices, edges and facets by their Hilbert keys: on a device the time of a sort hardly depends on its length.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "fast/kernels/bvh.hpp"

namespace ogc::fast {

/// Returns a tree over `count` primitives with the beginnings of its levels. Its pointers are null.
inline TreeView shape_of_tree(int count) {
  TreeView tree;
  tree.count = count;
  int total = 0;
  do {
    tree.start[tree.levels] = total;
    total += level_size(count, tree.levels);
  } while (level_size(count, tree.levels++) > 1 || tree.levels < 2);
  return tree;
}
/// Returns the number of nodes of all levels of a tree.
inline int node_count(const TreeView& tree) {
  return tree.start[tree.levels - 1] + level_size(tree.count, tree.levels - 1);
}

/// Holds the trees of one surface.
template <class Backend>
class Bvh {
 public:
  /// Orders primitives by index until the first rebuild; searches in this order are slow. `searched`: Surface::searched
  /// of the same surface.
  Bvh(const SurfaceView& surface, const std::vector<int>& searched) : surface_(surface) {
    const std::size_t total = static_cast<std::size_t>(facets_at()) + surface.searched_facets;
    std::vector<int> order = searched;
    if (order.empty()) {
      order.resize(total);
      std::iota(order.begin(), order.begin() + edges_at(), 0);
      std::iota(order.begin() + edges_at(), order.begin() + facets_at(), 0);
      std::iota(order.begin() + facets_at(), order.end(), 0);
    }
    order_.upload(order.data(), total);
    keys_.resize(total);
    vertex_limit_.resize(static_cast<std::size_t>(surface.vertex_count));
    no_radius_.resize(1);
    no_radius_.fill_zero();
    edges_ = allocate(surface.searched_edges, edge_nodes_, edge_arrivals_, order_.data() + edges_at());
    facets_ = allocate(surface.searched_facets, facet_nodes_, facet_arrivals_, order_.data() + facets_at());
  }

  /// Return the trees on the backend; boxes and reaches are those of the last refit.
  const TreeView& facets() const { return facets_; }
  const TreeView& edges() const { return edges_; }
  /// Returns the vertices in the order of a Hilbert curve.
  const int* vertex_order() const { return order_.data(); }
  const float* vertex_limit() const { return vertex_limit_.data(); }  ///< by vertex: gap limit of its reach

  /// Returns the functor that sets boxes at `positions`, and reaches (fast/kernels/bvh.hpp) of at most *query_radius.
  /// `search_limit` and `least` are those of Reach. The order of the trees stays. for_each runs the functor over its
  /// count(). If the surface has no facet, vertices get no reach.
  RefitTrees refit(const Vec* positions, const float* query_radius, const float* search_limit = nullptr,
                   float least = 0) {
    return {.reach = {surface_, positions, query_radius, search_limit, least},
            .facets = facets_,
            .edges = edges_,
            .facet_arrivals = facet_arrivals_.data(),
            .edge_arrivals = edge_arrivals_.data(),
            .vertex_limit = vertex_limit_.data(),
            .vertex_count = facets_.count > 0 ? surface_.vertex_count : 0};
  }

  /// Sorts the primitives anew for `positions`. Boxes are stale until the next refit.
  void rebuild(Backend& backend, const Vec* positions) {
    const RefitTrees boxes = refit(positions, no_radius_.data());
    backend.for_each(boxes.count(), boxes);
    const int total = facets_at() + surface_.searched_facets;
    backend.for_each(total, HilbertKeys{.surface = surface_,
                                        .positions = positions,
                                        .facets = facets_,
                                        .edges = edges_,
                                        .keys = keys_.data(),
                                        .values = order_.data()});
    backend.sort_pairs(keys_.data(), order_.data(), total, {HilbertKeys::lowest_sorted_bit, HilbertKeys::kind_bit + 2});
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  int edges_at() const { return surface_.searched_vertices; }
  int facets_at() const { return surface_.searched_vertices + surface_.searched_edges; }

  static TreeView allocate(int count, Buffer<Quad>& nodes, Buffer<int>& arrivals, const int* order) {
    TreeView tree = shape_of_tree(count);
    tree.order = order;
    const std::vector<Quad> all(static_cast<std::size_t>(node_count(tree)));
    nodes.upload(all.data(), all.size());
    tree.nodes = nodes.data();
    arrivals.resize(all.size());
    arrivals.fill_zero();
    return tree;
  }

  SurfaceView surface_;
  TreeView facets_, edges_;
  Buffer<Quad> facet_nodes_, edge_nodes_;
  Buffer<int> edge_arrivals_, facet_arrivals_, order_;
  Buffer<float> vertex_limit_, no_radius_;
  Buffer<std::uint64_t> keys_;
};

}  // namespace ogc::fast
