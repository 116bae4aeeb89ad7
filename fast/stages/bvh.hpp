// The two trees, over facets and over edges, and the order of the vertices. A refit is one launch for the primitives and one for every two levels;
// a rebuild is a refit in the old order, whose roots give the extent, and one sort of the Hilbert keys of all three kinds together (a sort's time hardly
// depends on its length on a device).
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "fast/kernels/bvh.hpp"

namespace ogc::fast {

template <class Backend>
class Bvh {
 public:
  /// In index order until the first rebuild: correct, but slow.
  explicit Bvh(const SurfaceView& surface) : surface_(surface) {
    const std::size_t total = static_cast<std::size_t>(surface.vertex_count) + surface.edge_count + surface.triangle_count;
    std::vector<int> order(total);
    std::iota(order.begin(), order.begin() + edges_at(), 0);
    std::iota(order.begin() + edges_at(), order.begin() + facets_at(), 0);
    std::iota(order.begin() + facets_at(), order.end(), 0);
    order_.upload(order.data(), total);
    keys_.resize(total);
    vertex_limit_.resize(std::max<std::size_t>(1, static_cast<std::size_t>(surface.vertex_count)));
    no_radius_.resize(1);
    no_radius_.fill_zero();
    edges_ = allocate(surface.edge_count, edge_nodes_, order_.data() + edges_at());
    facets_ = allocate(surface.triangle_count, facet_nodes_, order_.data() + facets_at());
  }

  const TreeView& facets() const { return facets_; }
  const TreeView& edges() const { return edges_; }
  const int* vertex_order() const { return order_.data(); }
  const float* vertex_limit() const { return vertex_limit_.data(); }  ///< gap limit of each vertex's reach

  /// Boxes at `positions` and reaches within *query_radius; the order stays. Nothing where the skin's pairs are rechecked. First the primitives, for_each over
  /// primitive_count(), then the nodes above them.
  RefitPrimitives primitives(const Vec* positions, const float* query_radius, const SkinView& skin = {}) {
    return {{surface_, positions, query_radius, skin.state}, facets_, edges_, vertex_limit_.data()};
  }
  int primitive_count() const { return facets_.count + edges_.count + surface_.vertex_count; }
  void refit_nodes(Backend& backend, const SkinView& skin = {}) {
    for (int level = 1; level < std::max(facets_.levels, edges_.levels); level += 2) {
      const int facet_nodes = level < facets_.levels ? level_size(facets_.count, level) : 0;
      const int edge_nodes = level < edges_.levels ? level_size(edges_.count, level) : 0;
      backend.for_each(facet_nodes + edge_nodes, RefitInner{facets_, edges_, level, facet_nodes, skin.state});
    }
  }

  /// A new order for `positions`; boxes are stale until the next refit.
  void rebuild(Backend& backend, const Vec* positions) {
    backend.for_each(primitive_count(), primitives(positions, no_radius_.data()));
    refit_nodes(backend);
    const int total = facets_at() + surface_.triangle_count;
    backend.for_each(total, HilbertKeys{surface_, positions, facets_, edges_, keys_.data(), order_.data()});
    backend.sort_pairs(keys_.data(), order_.data(), total);
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  int edges_at() const { return surface_.vertex_count; }
  int facets_at() const { return surface_.vertex_count + surface_.edge_count; }

  static TreeView allocate(int count, Buffer<Quad>& nodes, const int* order) {
    TreeView tree;
    tree.order = order;
    tree.count = count;
    int total = 0;
    do {
      tree.start[tree.levels] = total;
      total += level_size(count, tree.levels);
    } while (level_size(count, tree.levels++) > 1 || tree.levels < 2);
    Quad empty{};
    for (int lane = 0; lane < 4; ++lane) empty.set(lane, Box{}, 0);
    const std::vector<Quad> all(static_cast<std::size_t>(total), empty);
    nodes.upload(all.data(), all.size());
    tree.nodes = nodes.data();
    return tree;
  }

  SurfaceView surface_;
  TreeView facets_, edges_;
  Buffer<Quad> facet_nodes_, edge_nodes_;
  Buffer<int> order_;
  Buffer<float> vertex_limit_, no_radius_;
  Buffer<std::uint64_t> keys_;
};

}  // namespace ogc::fast
