// The policy of looking again: a Verlet list of pairs with a skin (fast/kernels/skin.hpp), or a search each time.
// Either way a detection calls `prepare` before its searches and `complete` after them. Unlike the other lists this one
// may be too small: then a detection searches, and the host, when it looks the next time, gives the list more room. It
// begins with room for few pairs, since many callers never need it.
#pragma once

#include <algorithm>
#include <cstddef>

#include "fast/kernels/detection.hpp"
#include "fast/kernels/skin.hpp"

namespace ogc::fast {

/// Memory and launches of the list of one surface.
template <class Backend>
class Skin {
 public:
  /// `share`: largest m/r; 0 for none, every detection searches.
  Skin(const SurfaceView& surface, float share) : share_(share), surface_(surface) {
    const auto size = [](int n) { return static_cast<std::size_t>(n); };
    forget();
    if (!is_used()) return;
    anchor_.resize(size(surface.vertex_count));
    vertex_.resize(size(surface.vertex_count)), edge_.resize(size(surface.edge_count)),
        triangle_.resize(size(surface.triangle_count));
    pairs_.resize(size(capacity_));
  }

  /// As kernels see it.
  SkinView view(float contact_radius) {
    return {.state = state_.data(),
            .largest_margin = share_ * contact_radius,
            .contact_radius = contact_radius,
            .pairs = pairs_.data(),
            .capacity = capacity_,
            .anchor = anchor_.data(),
            .vertex = vertex_.data(),
            .edge = edge_.data(),
            .triangle = triangle_.data()};
  }

  /// All that stands before the searches: `launches` prepares the detection, `refit` the trees. With a skin the choice
  /// between search and list stands in between.
  template <class Launches>
  void prepare(Backend& backend, const SkinView& skin, const Launches& launches, const PrepareDetection& prepare,
               const RefitTrees& refit) {
    const int items = std::max(prepare.lists.lists.buckets, surface_.triangle_count);
    if (!is_used()) return launches.prepare_and_refit(backend, items, prepare, refit);
    const int* overflow = prepare.lists.lists.overflow;
    launches.prepare(backend, items, prepare, surface_.vertex_count, MeasureDrift{skin, prepare.positions, overflow});
    backend.for_each(1, ChooseSkinMode{skin, prepare.distances.query_radius, overflow});
    backend.for_each(refit.count(), refit);
  }

  /// All that stands after the searches: a look at the list in their place, and where vertices were at a search.
  void complete(Backend& backend, const DetectVertexFacet& vertex_facet, const DetectEdgeEdge& edge_edge,
                const Vec* positions) {
    if (!is_used()) return;
    const SkinView& skin = edge_edge.skin;
    // after a search the one does nothing, after a look at the list the other
    backend.for_both(std::max({surface_.vertex_count, surface_.edge_count, surface_.triangle_count}),
                     KeepAnchor{.skin = skin,
                                .surface = surface_,
                                .positions = positions,
                                .d_min_vertex = vertex_facet.d_min_vertex,
                                .d_min_edge = edge_edge.d_min_edge,
                                .d_min_triangle = vertex_facet.d_min_triangle},
                     &skin.state->count, skin.capacity, RecheckPairs{vertex_facet, edge_edge});
  }

  /// Host only: the next detection searches.
  void forget() {
    const SkinState fresh;
    state_.upload(&fresh, 1);
  }

  /// Host only: room for half as many pairs again as the longest list had, where that found none; true where something
  /// moved.
  bool make_room() {
    if (!is_used()) return false;
    const SkinState now = state();
    const int most = std::max(now.most, now.count);
    if (most <= capacity_) return false;
    capacity_ = most + most / 2;
    pairs_.resize(static_cast<std::size_t>(capacity_));
    forget();
    return true;
  }

  /// Host only.
  SkinState state() const {
    SkinState now;
    state_.download(&now, 1);
    return now;
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  /// Whether a detection may ever do anything but search.
  bool is_used() const { return share_ > 0; }

  float share_;
  SurfaceView surface_;
  int capacity_ = 1 << 14;  // 128 KiB
  Buffer<SkinState> state_;
  Buffer<NotedPair> pairs_;
  Buffer<Vec> anchor_;
  Buffer<float> vertex_, edge_, triangle_;
};

}  // namespace ogc::fast
