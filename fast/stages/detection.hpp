// A whole detection: trees at the current positions and both queries, or a look at the pairs that a search kept; lists,
// bounds (Alg. 3 lines 4–19). All of it is enqueued, nothing waits and nothing is allocated, so it may stand inside
// Backend::when. Once a list has overflowed every launch does nothing until `grow`, so that the needed size stays that
// of the first detection that had no room, and the contacts of the last complete one are not mixed with others.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "fast/contact_view.hpp"
#include "fast/kernels/bound.hpp"
#include "fast/stages/backend.hpp"
#include "fast/stages/bvh.hpp"
#include "fast/stages/detect_edge_edge.hpp"
#include "fast/stages/detect_vertex_facet.hpp"
#include "fast/stages/lists.hpp"
#include "fast/stages/planes.hpp"
#include "fast/stages/skin.hpp"
#include "fast/stages/surface.hpp"

namespace ogc::fast {

/// The pairs of the list with a skin, in place of a search; index over all of them.
struct RecheckPairs {
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

/// What every launch of a detection starts from, and what the caller has to do for each vertex before it.
template <class Before>
struct PrepareDetection {
  Before before;
  const Vec* positions;
  Place* places;
  PrepareLists lists;
  ResetDistances distances;

  OGC_HD void operator()(int i) const {
    if (i < distances.vertex_count) {
      before(i);
      places[i] = Place(positions[i]);
    }
    lists(i);
    distances(i);
  }
};

/// Both at once, where no skin decides in between whether the trees are needed; whole warps of 32.
template <class Before>
struct PrepareAndRefit {
  PrepareDetection<Before> prepare;
  RefitTrees refit;

  OGC_HD void operator()(int i) const {
    prepare(i);
    refit(i);
  }
};

/// What a caller has done on the way, to spare launches: before(v) for each vertex, which may read the bounds that end
/// with the detection and write nothing that it reads; in its last launch after(i) for 0 ≤ i < after_count, when
/// overflow(), the incidences' rows and what stands in each are known (loose_incidences), and resolve(place, incidence)
/// for each incidence.
template <class Before = Decided, class After = Decided, class Resolve = Unresolved>
struct OnTheWay {
  Before before{};
  int after_count = 0;
  After after{};
  Resolve resolve{};
};

template <class Backend>
class Detection {
 public:
  /// `exclusions`: see compare/stages/detect.hpp. `capacity`: contacts at first; 0 for a guess by mesh size. `skin`:
  /// largest margin of the list of pairs as a part of r; 0 for none. It changes the time alone. `is_fixed`: by vertex,
  /// read where `bounds` are planes.
  Detection(Backend& backend, const compare::Topology& topology, const compare::ExclusionView& exclusions,
            int capacity = 0, float skin = 0, compare::Bounds bounds = compare::Bounds::ball,
            const std::vector<std::uint8_t>& is_fixed = {})
      : backend_(backend),
        surface_(topology, exclusions),
        bvh_(surface_.view()),
        skin_(surface_.view(), skin),
        lists_(surface_.view(), capacity > 0 ? capacity : 1024 + 4 * topology.vertex_count),
        planes_(bounds, is_fixed) {
    planes_.reserve(lists_.noted_capacity());
    const SurfaceView surface = surface_.view();
    const auto vertices = static_cast<std::size_t>(surface.vertex_count);
    for (auto* by_vertex : {&d_min_vertex_, &bound_}) by_vertex->resize(vertices), by_vertex->fill_zero();
    places_.resize(vertices);
    d_min_edge_.resize(static_cast<std::size_t>(surface.edge_count));
    d_min_triangle_.resize(static_cast<std::size_t>(surface.triangle_count));
  }

  /// New order of the trees for `positions`: worth its sort every few steps. Enqueued like a detection, and never
  /// needed for a right answer.
  void rebuild(const Vec* positions) { bvh_.rebuild(backend_, positions); }

  /// Contact sets, smallest distances and bounds at `positions` (on the backend). r = contact_radius [m], r_q =
  /// *query_radius ≥ r [m] (on the backend), γ_p = bound_relaxation. A no-op while *overflow() is set.
  template <class Before = Decided, class After = Decided, class Resolve = Unresolved>
  void detect(const Vec* positions, float contact_radius, const float* query_radius, float bound_relaxation,
              const OnTheWay<Before, After, Resolve>& on_the_way = {}) {
    const SurfaceView surface = surface_.view();
    const ListsView lists = lists_.view();
    const SkinView skin = skin_.view(contact_radius);
    float *d_vertex = d_min_vertex_.data(), *d_edge = d_min_edge_.data(), *d_triangle = d_min_triangle_.data();
    const PrepareDetection<Before> prepare{on_the_way.before,
                                           positions,
                                           places_.data(),
                                           {lists, surface.vertex_count},
                                           {query_radius, lists.overflow, surface.vertex_count, surface.edge_count,
                                            surface.triangle_count, d_vertex, d_edge, d_triangle}};
    const int items = std::max(lists.buckets, surface.triangle_count);
    const RefitTrees refit = bvh_.refit(positions, query_radius, skin);
    if (skin_.is_used()) {
      backend_.for_each(items, prepare);
      backend_.for_each(surface.vertex_count, MeasureDrift{skin, positions, lists.overflow});
      backend_.for_each(1, ChooseSkinMode{skin, query_radius, lists.overflow});
      backend_.for_each(refit.count(), refit);
    } else {
      backend_.for_each(RefitTrees::filled_up(std::max(items, refit.count())), PrepareAndRefit<Before>{prepare, refit});
    }
    const Places places{places_.data()};
    const DetectVertexFacet vertex_facet{
        surface, places,         bvh_.facets(), bvh_.vertex_order(), bvh_.vertex_limit(), lists,
        skin,    contact_radius, d_vertex,      d_triangle};
    const DetectEdgeEdge edge_edge{surface, places, bvh_.edges(), lists, skin, contact_radius, d_edge};
    if (planes_.is_used()) {
      backend_.search(Searches<NearEdgeEdge>{bvh_.edges(), surface.edge_count, {edge_edge, query_radius}},
                      Searches<NearVertexFacet>{bvh_.facets(), surface.vertex_count, {vertex_facet, query_radius}});
      planes_.make(backend_, surface, places, lists, bound_relaxation, query_radius, bound_.data());
      lists_.assemble(backend_, places, contact_radius, 0, Decided{}, on_the_way.after_count, on_the_way.after,
                      on_the_way.resolve, planes_.planes());
      return;
    }
    backend_.search(searches_of(edge_edge), searches_of(vertex_facet));
    if (skin_.is_used()) {
      backend_.for_each_counted(&skin.state->count, skin.capacity, RecheckPairs{vertex_facet, edge_edge});
      backend_.for_each(std::max({surface.vertex_count, surface.edge_count, surface.triangle_count}),
                        KeepAnchor{skin, surface, positions, d_vertex, d_edge, d_triangle});
    }
    const ConservativeBound bounds{surface,          d_vertex,       d_edge,       d_triangle,
                                   bound_relaxation, lists.overflow, bound_.data()};
    lists_.assemble(backend_, places, contact_radius, surface.vertex_count, bounds, on_the_way.after_count,
                    on_the_way.after, on_the_way.resolve);
  }

  /// Of the last complete detection; valid until grow() returns true.
  ContactView view() {
    const ListsView lists = lists_.view();
    return {lists.vertex_facet,
            lists.edge_edge,
            lists_.vertex_facet_count(),
            lists_.edge_edge_count(),
            lists.incidence_offsets,
            lists.incidences,
            bound_.data(),
            planes_.is_used() ? planes_.nearest() : d_min_vertex_.data()};
  }

  /// Host only: see Planes::download.
  compare::VertexPlanes download_planes() const { return planes_.download(); }
  /// Beside the balls of view().
  RegionView regions() const { return planes_.regions(); }

  /// Incidences in the rows of ContactView::incidence_offsets, in any order within one.
  const LooseIncidence* loose_incidences() { return lists_.view().loose; }

  /// On the backend, not 0 once a list was too small. Work that must not run on incomplete sets asks this first; only
  /// grow() clears it.
  const int* overflow() const { return lists_.overflow(); }

  /// Host only: enlarges what was too small and clears the flag; true where there was anything to do, and the detection
  /// has to be repeated.
  bool grow() {
    const bool grown = lists_.grow();
    if (grown) skin_.forget();  // its detection may have ended half way
    planes_.reserve(lists_.noted_capacity());
    return grown;
  }
  /// Host only: room for the pairs of the skin, where they found none; true where something has moved.
  bool make_room() { return skin_.make_room(); }
  /// Host only: how detections went so far.
  SkinState skin_state() const { return skin_.state(); }

  /// Contacts that fit before the lists have to grow.
  int capacity() const { return lists_.capacity(); }
  /// Those of all lists, for `reserve` of another detection over the same surface.
  std::vector<std::int64_t> capacities() const { return {lists_.capacity(), lists_.noted_capacity()}; }
  /// Host only: gives the lists the capacities that another detection had. Throws std::invalid_argument where they are
  /// not of such lists.
  void reserve(const std::vector<std::int64_t>& capacities) {
    const auto possible = [](std::int64_t capacity) {
      return capacity > 0 && capacity <= std::numeric_limits<int>::max();
    };
    if (capacities.size() != 2 || !std::all_of(capacities.begin(), capacities.end(), possible))
      throw std::invalid_argument("capacities of other lists");
    lists_.reserve(static_cast<int>(capacities[0]), static_cast<int>(capacities[1]));
    skin_.forget();
    planes_.reserve(lists_.noted_capacity());
  }

  const float* d_min_vertex() const { return d_min_vertex_.data(); }      ///< Eq. 22, rounded down [m]
  const float* d_min_edge() const { return d_min_edge_.data(); }          ///< Eq. 24
  const float* d_min_triangle() const { return d_min_triangle_.data(); }  ///< Eq. 26
  /// The contact face of each vertex–facet record, as SurfaceView numbers faces.
  const int* vertex_facet_faces() { return lists_.view().vertex_facet_face; }

 private:
  Backend& backend_;
  Surface<Backend> surface_;
  Bvh<Backend> bvh_;
  Skin<Backend> skin_;
  Lists<Backend> lists_;
  Planes<Backend> planes_;
  typename Backend::template Buffer<Place> places_;  ///< positions of the last detection
  typename Backend::template Buffer<float> d_min_vertex_, d_min_edge_, d_min_triangle_, bound_;
};

}  // namespace ogc::fast
