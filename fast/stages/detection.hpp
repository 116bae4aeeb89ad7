// Runs a whole detection (Alg. 3 lines 4–19): trees at the current positions, both queries, lists, bounds. Everything
// is enqueued; nothing waits or allocates, so a detection may be inside Backend::when. After a list has overflowed,
// every launch does nothing until `grow`. So `grow` reads the size that the overflowed detection needs, and the
// contacts of the last complete detection stay as they are.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "fast/contact_view.hpp"
#include "fast/kernels/bound.hpp"
#include "fast/kernels/detection.hpp"
#include "fast/stages/backend.hpp"
#include "fast/stages/bvh.hpp"
#include "fast/stages/detect_edge_edge.hpp"
#include "fast/stages/detect_vertex_facet.hpp"
#include "fast/stages/lists.hpp"
#include "fast/stages/parts.hpp"
#include "fast/stages/planes.hpp"
#include "fast/stages/surface.hpp"

namespace ogc::fast {

/// Runs the first and the last launch of a detection outside a step. StepLaunches (fast/stages/step_detection.hpp) adds
/// the work of a step to both launches.
struct PlainLaunches {
  /// Runs the first launch.
  template <class Backend>
  void begin(Backend& backend, const BeginDetection& detection) const {
    backend.for_each(detection.count(), detection);
  }
  /// Runs the last launch, over *count ≤ `capacity` incidences.
  template <class Backend>
  void rank(Backend& backend, const ListsView& lists, const int* count, int capacity) const {
    backend.for_each_counted(count, capacity, RankIncidences{lists});
  }
};

/// Holds the resident detection of one surface.
template <class Backend>
class Detection {
 public:
  /// `exclusions`: see compare/stages/detect.hpp. `capacity`: number of contacts for which the lists have room at
  /// first; 0: estimated from the size of the mesh. `is_fixed`: by vertex, read only if `bounds` are planes.
  Detection(Backend& backend, const compare::Topology& topology, const compare::ExclusionView& exclusions,
            int capacity = 0, compare::Bounds bounds = compare::Bounds::ball,
            const std::vector<std::uint8_t>& is_fixed = {})
      : backend_(backend),
        surface_(topology, exclusions),
        bvh_(surface_.view(), surface_.searched()),
        lists_(surface_.view(), capacity > 0 ? capacity : 1024 + 4 * topology.vertex_count),
        planes_(bounds, is_fixed) {
    planes_.reserve(lists_.noted_capacity());
    const SurfaceView surface = surface_.view();
    const auto vertices = static_cast<std::size_t>(surface.vertex_count);
    for (auto* by_vertex : {&d_min_vertex_, &bound_}) by_vertex->resize(vertices), by_vertex->fill_zero();
    padded_.resize(vertices);
    d_min_edge_.resize(static_cast<std::size_t>(surface.edge_count));
    d_min_triangle_.resize(static_cast<std::size_t>(surface.triangle_count));
  }

  /// Forwards to Lists::number_rows.
  void number_rows(const int* places) { lists_.number_rows(places); }

  /// Sorts the trees anew for `positions`. A sort every few steps saves more time than it takes, and it changes no
  /// result. It is enqueued like a detection.
  void rebuild(const Vec* positions) { bvh_.rebuild(backend_, positions); }

  /// Computes contact sets, smallest distances and bounds at `positions` (on the backend). r = contact_radius [m], r_q
  /// = *query_radius ≥ r [m] (on the backend), γ_p = bounds_relaxation. Does nothing while *overflow() is not 0.
  /// `launches` runs the first and the last launch, to which it may add work of the caller.
  template <class Launches = PlainLaunches>
  void detect(const Vec* positions, float contact_radius, const float* query_radius, float bounds_relaxation,
              const Launches& launches = {}) {
    find(positions, contact_radius, query_radius, launches);
    const auto assemble = [&] {
      lists_.collect_contacts(backend_, {padded_.data()}, contact_radius, bounded(), bounds(bounds_relaxation),
                              planes_.distances());
      if (is_divided()) parts_->share_contacts(lists_.view(), {surface_.view()}, bounds(bounds_relaxation));
      lists_.assemble(backend_, launches);
    };
    if (!planes_.is_used()) return assemble();
    backend_.at_once(
        [&] {
          planes_.make(backend_, surface_.view(), {padded_.data()}, lists_.view(), bounds_relaxation, query_radius,
                       bound_.data());
        },
        assemble);
  }

  /// Return surface, positions and lists as kernels see them; the positions are those of the last detection.
  SurfaceView surface() { return surface_.view(); }
  PaddedVecs positions() { return {padded_.data()}; }
  ListsView lists() { return lists_.view(); }

  /// Returns the contacts of the last complete detection, valid until grow() returns true.
  ContactView view() {
    const ListsView lists = lists_.view();
    return {.vertex_facet = lists.vertex_facet,
            .edge_edge = lists.edge_edge,
            .vertex_facet_count = lists_.vertex_facet_count(),
            .edge_edge_count = lists_.edge_edge_count(),
            .rows = lists.rows,
            .incidence_offsets = lists.incidence_offsets,
            .incidences = lists.incidences,
            .bound = bound_.data(),
            .d_min_vertex = planes_.is_used() ? planes_.nearest() : d_min_vertex_.data()};
  }

  /// Divides the searches and the contacts among the parts of a simulation; `parts` must outlive the detection.
  void divide(Parts<Backend>& parts) {
    parts_ = &parts;
    if (is_divided()) lists_.keep_own_rows(parts.readers());
  }
  /// Adds the arrays that other parts read.
  void publish(PartArrays& arrays) {
    arrays.d_min_vertex = d_min_vertex_.data(), arrays.d_min_edge = d_min_edge_.data(),
    arrays.d_min_triangle = d_min_triangle_.data(), arrays.bound = bound_.data();
  }

  /// Forwards to Planes::divide_by.
  void divide_planes_by(const Vec* displacement) { planes_.divide_by(displacement); }
  /// Host only: returns, by vertex, how far a detection at `positions` (on the backend) searches for all pairs of a
  /// vertex [m]; empty if bounds are not planes. put_search_limits sets these limits for the next detection.
  std::vector<float> search_limits(const Vec* positions) {
    planes_.limit_searches(backend_, surface_.view(), positions, lists_.view());
    backend_.synchronize();
    return planes_.download_search_limits();
  }
  void put_search_limits(const std::vector<float>& limits) { planes_.put_search_limits(limits); }
  /// Host only: forwards to Planes::download.
  compare::VertexPlanes download_planes() const { return planes_.download(); }
  /// Returns the regions of the last complete detection. `centre`: the positions of that detection, on the backend.
  FeasibleRegions regions(const Vec* centre) const { return planes_.regions(centre, bound_.data()); }

  /// Returns a flag on the backend that is not 0 if a list was too small. Work that needs complete sets reads the flag
  /// first. Only grow() clears it.
  const int* overflow() const { return lists_.overflow(); }

  /// Host only: enlarges each list that was too small and clears the flag. Returns whether a list was too small, so
  /// that the detection has to be repeated.
  bool grow() {
    if (!lists_.grow()) return false;
    planes_.reserve(lists_.noted_capacity());
    return true;
  }

  /// Forwards to Lists::room.
  ListRoom room() const { return lists_.room(); }
  /// Host only: forwards to Lists::make_room.
  bool make_room() {
    if (!lists_.make_room()) return false;
    planes_.reserve(lists_.noted_capacity());
    return true;
  }
  /// Host only: empties lists, bounds and planes, as if nothing was detected yet.
  void forget() {
    lists_.reserve(lists_.capacity(), lists_.noted_capacity());
    planes_.reserve(lists_.noted_capacity());
    planes_.forget();
    bound_.fill_zero();
  }

  /// Returns the number of contacts for which the lists have room.
  int capacity() const { return lists_.capacity(); }
  /// Returns the capacities of all lists, for `reserve` of another detection over the same surface.
  std::vector<std::int64_t> capacities() const { return {lists_.capacity(), lists_.noted_capacity()}; }
  /// Host only: sets the capacities of the lists to those of another detection. Throws std::invalid_argument if they
  /// cannot be capacities of these lists.
  void reserve(const std::vector<std::int64_t>& capacities) {
    const auto possible = [](std::int64_t capacity) {
      return capacity > 0 && capacity <= std::numeric_limits<int>::max();
    };
    if (capacities.size() != 2 || !std::all_of(capacities.begin(), capacities.end(), possible))
      throw std::invalid_argument("capacities of other lists");
    lists_.reserve(static_cast<int>(capacities[0]), static_cast<int>(capacities[1]));
    planes_.reserve(lists_.noted_capacity());
  }

  const float* d_min_vertex() const { return d_min_vertex_.data(); }      ///< Eq. 22, rounded down [m]
  const float* d_min_edge() const { return d_min_edge_.data(); }          ///< Eq. 24
  const float* d_min_triangle() const { return d_min_triangle_.data(); }  ///< Eq. 26
  /// Returns the contact face of each vertex–facet record; SurfaceView defines the numbers of faces.
  const int* vertex_facet_faces() { return lists_.view().vertex_facet_face; }

 private:
  /// Enqueues the launches before the lists: refits the trees, notes pairs and computes smallest distances; with planes
  /// the distances of all noted pairs.
  template <class Launches>
  void find(const Vec* positions, float contact_radius, const float* query_radius, const Launches& launches) {
    const SurfaceView surface = surface_.view();
    const ListsView lists = lists_.view();
    const ResetDistances distances{.query_radius = query_radius,
                                   .overflow = lists.overflow,
                                   .vertex_count = surface.vertex_count,
                                   .edge_count = surface.edge_count,
                                   .triangle_count = surface.triangle_count,
                                   .d_min_vertex = d_min_vertex_.data(),
                                   .d_min_edge = d_min_edge_.data(),
                                   .d_min_triangle = d_min_triangle_.data()};
    planes_.limit_searches(backend_, surface, positions, lists);
    launches.begin(backend_,
                   BeginDetection{positions,
                                  padded_.data(),
                                  {lists},
                                  distances,
                                  planes_.prepare(surface, query_radius, lists),
                                  bvh_.refit(positions, query_radius, planes_.search_limits(), contact_radius)});
    const DetectVertexFacet vertex_facet = vertex_facet_query(contact_radius);
    const DetectEdgeEdge edge_edge = edge_edge_query(contact_radius);
    if (planes_.is_used()) {
      backend_.search(Searches<NearEdgeEdge>{bvh_.edges(), surface.searched_edges, {edge_edge}},
                      Searches<NearVertexFacet>{bvh_.facets(), facet_searches(), {vertex_facet}});
      planes_.measure(backend_, surface, vertex_facet.positions, lists, contact_radius, query_radius);
    } else {
      const Searches<DetectEdgeEdge> edges = searches_of(edge_edge);
      const Searches<DetectVertexFacet> facets = searches_of(vertex_facet);
      if (is_divided())
        backend_.search(edges.of_part(parts_->count(), parts_->own()), facets.of_part(parts_->count(), parts_->own()));
      else
        backend_.search(edges, facets);
    }
  }

  bool is_divided() const { return parts_ != nullptr && parts_->is_one_of_several(); }

  /// Returns the number of searches for facets; 0 if there is no facet.
  int facet_searches() { return searches_of(vertex_facet_query(0)).count; }

  DetectVertexFacet vertex_facet_query(float contact_radius) {
    return {.surface = surface_.view(),
            .positions = {padded_.data()},
            .tree = bvh_.facets(),
            .vertex_order = bvh_.vertex_order(),
            .vertex_limit = bvh_.vertex_limit(),
            .lists = lists_.view(),
            .contact_radius = contact_radius,
            .d_min_vertex = d_min_vertex_.data(),
            .d_min_triangle = d_min_triangle_.data()};
  }
  DetectEdgeEdge edge_edge_query(float contact_radius) {
    return {.surface = surface_.view(),
            .positions = {padded_.data()},
            .tree = bvh_.edges(),
            .lists = lists_.view(),
            .contact_radius = contact_radius,
            .d_min_edge = d_min_edge_.data()};
  }

  /// Returns the number of vertices whose bounds are computed in the first launch of the lists. If bounds are planes,
  /// they are computed earlier; bounds of several parts need the distances of all.
  int bounded() const { return planes_.is_used() || is_divided() ? 0 : surface_.view().vertex_count; }

  ConservativeBound bounds(float bounds_relaxation) {
    return {.surface = surface_.view(),
            .d_min_vertex = d_min_vertex_.data(),
            .d_min_edge = d_min_edge_.data(),
            .d_min_triangle = d_min_triangle_.data(),
            .bounds_relaxation = bounds_relaxation,
            .overflow = lists_.overflow(),
            .bound = bound_.data()};
  }

  Backend& backend_;
  Surface<Backend> surface_;
  Bvh<Backend> bvh_;
  Lists<Backend> lists_;
  Planes<Backend> planes_;
  Parts<Backend>* parts_ = nullptr;
  typename Backend::template Buffer<PaddedVec> padded_;  ///< positions of the last detection
  typename Backend::template Buffer<float> d_min_vertex_, d_min_edge_, d_min_triangle_, bound_;
};

}  // namespace ogc::fast
