// Holds the memory of a detection's planes (fast/kernels/plane_lists.hpp) and launches their kernels. If the scene's
// bounds are not planes, the memory is empty and nothing is launched.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "compare/problem/settings.hpp"
#include "compare/stages/plane.hpp"
#include "fast/kernels/near_pairs.hpp"
#include "fast/kernels/plane_lists.hpp"
#include "fast/stages/backend.hpp"

namespace ogc::fast {

template <class Backend>
class Planes {
 public:
  /// `is_fixed`: by vertex, whether it never moves; read only if bounds are planes.
  Planes(compare::Bounds bounds, const std::vector<std::uint8_t>& is_fixed) : policy_(traits_of(bounds)) {
    if (!is_used()) return;
    const std::size_t vertices = is_fixed.size();
    is_fixed_.upload(is_fixed.data(), vertices);
    for (Buffer<int>* counts : {&pair_counts_, &counts_}) {
      counts->resize(vertices);
      counts->fill_zero();
    }
    pair_offsets_.resize(vertices + 1), no_sum_.resize(1);
    for (Buffer<float>* by_vertex : {&threshold_, &nearest_, &unplaned_, &search_limit_, &inner_})
      by_vertex->resize(vertices);
    for (Buffer<HalfSpace>* planes : {&placed_, &rows_}) planes->resize(vertices * most_planes);
    for (Buffer<NotedPair>* pairs : {&placed_pairs_, &pairs_}) pairs->resize(vertices * most_planes);
  }

  /// Whether bounds are planes.
  bool is_used() const { return policy_.has_planes; }
  /// Sets displacements [m], by vertex, on the backend. Later detections divide the gap of a pair in the ratio of its
  /// sides' displacements. If null, gaps are halved.
  void divide_by(const Vec* displacement) { displacement_ = displacement; }

  /// Host only: makes room for this number of noted pairs, and forgets the pairs that limit the next search.
  void reserve(int noted_capacity) {
    if (!is_used()) return;
    const std::vector<float> all(search_limit_.size(), infinity);
    search_limit_.upload(all.data(), all.size());
    threshold_.upload(all.data(), all.size());
    distance_.resize(static_cast<std::size_t>(noted_capacity));
    places_.resize(static_cast<std::size_t>(noted_capacity));
    pair_rows_.resize(4 * static_cast<std::size_t>(noted_capacity));
  }

  /// Host only: forgets the half-spaces of the last detection.
  void forget() { counts_.fill_zero(); }

  /// Returns the feasible regions: X_prev, b_v and the half-spaces of the last detection.
  FeasibleRegions regions(const Vec* centre, const float* radius) const {
    FeasibleRegions regions{.centre = centre, .radius = radius, .is_off = !policy_.certifies, .slides = policy_.slides};
    if (is_used()) regions.planes = rows_.data(), regions.counts = counts_.data(), regions.inner = inner_.data();
    return regions;
  }
  /// Returns, by vertex, a lower bound of the distance of its nearest pair, at most r_q [m].
  const float* nearest() const { return nearest_.data(); }
  /// Returns, by noted pair, a lower bound of its distance [m]; null if bounds are not planes.
  const float* distances() const { return is_used() ? distance_.data() : nullptr; }

  /// Returns, by vertex, the distance within which a search must note all of its pairs [m]; null if bounds are not
  /// planes.
  const float* search_limits() const { return is_used() ? search_limit_.data() : nullptr; }
  /// Limits the next search, at `positions` (by vertex, on the backend), by the pairs that the last one noted.
  void limit_searches(Backend& backend, const SurfaceView& surface, const Vec* positions, const ListsView& noted) {
    if (!is_used()) return;
    backend.for_each_counted(noted.noted_count, noted.noted_capacity, LimitSearches{view(surface, noted), positions});
  }

  /// Host only: `download_search_limits` returns search_limits(); empty if bounds are not planes. `put_search_limits`
  /// sets it for the next search, unless `limits` is empty. Throws std::invalid_argument if the number of limits is not
  /// that of the vertices.
  std::vector<float> download_search_limits() const {
    std::vector<float> limits(search_limit_.size());
    if (is_used()) search_limit_.download(limits.data(), limits.size());
    return limits;
  }
  void put_search_limits(const std::vector<float>& limits) {
    if (limits.empty() || !is_used()) return;
    if (limits.size() != search_limit_.size()) throw std::invalid_argument("search limits of another mesh");
    search_limit_.upload(limits.data(), limits.size());
  }

  /// Returns the functor that prepares the arrays for a detection; it does nothing if bounds are not planes.
  PreparePlanes prepare(const SurfaceView& surface, const float* query_radius, const ListsView& noted) {
    if (!is_used()) return {};
    PlaneListsView lists = view(surface, noted);
    lists.query_radius = query_radius;
    return {lists};
  }

  /// Computes the distances of the pairs that the searches noted. `contact_radius`: r with the margin. If some pairs
  /// found no room in the list, the results of `measure` and `make` must not be used.
  void measure(Backend& backend, const SurfaceView& surface, PaddedVecs positions, const ListsView& noted,
               float contact_radius, const float* query_radius) {
    PlaneListsView lists = view(surface, noted);
    lists.positions = positions;
    lists.query_radius = query_radius;
    lists.contact_radius = contact_radius;
    backend.for_each_counted(noted.noted_count, noted.noted_capacity, MeasurePairs{lists});
  }

  /// Makes planes and balls (`bound`) from the pairs that `measure` measured.
  void make(Backend& backend, const SurfaceView& surface, PaddedVecs positions, const ListsView& noted, float share,
            const float* query_radius, float* bound) {
    PlaneListsView lists = view(surface, noted);
    lists.positions = positions;
    lists.share = share;
    lists.query_radius = query_radius;
    lists.bound = bound;
    const int vertices = surface.vertex_count, capacity = noted.noted_capacity;
    backend.exclusive_scans({lists.pair_counts, lists.pair_offsets, vertices}, {lists.pair_counts, no_sum_.data(), 0});
    backend.for_each_counted(noted.noted_count, capacity, FillPairRows{lists});
    backend.for_each_row(vertices, lists.pair_offsets, lists.pair_rows, ChooseThreshold{lists});
    backend.for_each_counted(noted.noted_count, capacity, PlacePlanes{lists});
    backend.for_each(vertices * most_planes, SortHalfSpaces{lists});
  }

  /// Host only: returns each vertex's planes of the last detection; empty if bounds are not planes.
  compare::VertexPlanes download() const {
    compare::VertexPlanes planes;
    if (!is_used()) return planes;
    std::vector<int> counts(counts_.size());
    std::vector<HalfSpace> rows(rows_.size());
    std::vector<NotedPair> pairs(pairs_.size());
    counts_.download(counts.data(), counts.size());
    rows_.download(rows.data(), rows.size());
    pairs_.download(pairs.data(), pairs.size());
    planes.offsets.push_back(0);
    for (std::size_t v = 0; v < counts.size(); ++v) {
      for (int k = 0; k < counts[v]; ++k) {
        const std::size_t i = v * most_planes + static_cast<std::size_t>(k);
        const Vec& n = rows[i].normal;
        planes.items.push_back({primitives(pairs[i]), {n.x, n.y, n.z}, rows[i].offset});
      }
      planes.offsets.push_back(static_cast<compare::Index>(planes.items.size()));
    }
    return planes;
  }

 private:
  static compare::PrimitivePair primitives(const NotedPair& pair) {
    using Kind = compare::PrimitivePair::Kind;
    if (pair.first < 0) return {Kind::vertex_triangle, ~pair.first, pair.second};
    return {Kind::edge_edge, pair.first, pair.second};
  }

  /// Returns the arrays of this object and the noted pairs.
  PlaneListsView view(const SurfaceView& surface, const ListsView& noted) {
    return {.surface = surface,
            .is_fixed = is_fixed_.data(),
            .displacement = displacement_,
            .noted = noted.noted,
            .distance = distance_.data(),
            .places = places_.data(),
            .pair_counts = pair_counts_.data(),
            .pair_offsets = pair_offsets_.data(),
            .pair_rows = pair_rows_.data(),
            .threshold = threshold_.data(),
            .nearest = nearest_.data(),
            .unplaned = unplaned_.data(),
            .placed = placed_.data(),
            .placed_pairs = placed_pairs_.data(),
            .rows = rows_.data(),
            .pairs = pairs_.data(),
            .search_limit = search_limit_.data(),
            .inner = inner_.data(),
            .counts = counts_.data()};
  }

  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  compare::BoundsTraits policy_;
  const Vec* displacement_ = nullptr;
  Buffer<std::uint8_t> is_fixed_;
  Buffer<float> distance_, pair_rows_, threshold_, nearest_, unplaned_, search_limit_, inner_;
  Buffer<RowPlaces> places_;
  Buffer<int> pair_counts_, pair_offsets_, counts_, no_sum_;
  Buffer<HalfSpace> placed_, rows_;
  Buffer<NotedPair> placed_pairs_, pairs_;
};

}  // namespace ogc::fast
