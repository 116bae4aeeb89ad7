// Converts the pairs within r_q that a search noted into half-spaces and a ball for each vertex (method.md §5.6):
//
//   LimitSearches    for each pair of the last detection, before the search: limits the searches of its vertices
//   (the searches)
//   MeasurePairs     for each pair: its distance, and its place in the row of each of its vertices
//   (from here on beside the lists of contacts: a scan of the rows' lengths)
//   FillPairRows     for each pair: enters its distance in these rows
//   ChooseThreshold  for each row: δ_v, the (N+1)-th smallest distance
//   PlacePlanes      for each pair: places a plane if it is nearer than δ_v for all its vertices; otherwise its
//                    distance limits the balls of its vertices
//   SortHalfSpaces   for each plane: moves it to its place in ascending order of pairs; for each vertex: writes its
//                    ball
//
// No result depends on the order in which pairs were noted: planes are sorted, a threshold is the (N+1)-th of sorted
// distances, and a ball's radius is a minimum. Fixed vertices have no planes and no row.
//
// Pairs beyond δ_v change no result: they have no plane at v, and a pair at distance δ_v limits v's ball more. So a
// search may stop at any distance within which v has N + 1 pairs. The N + 1 nearest pairs of the last detection give
// one: the largest of their distances at the new positions is an upper bound of the new δ_v. Rounding is covered as
// Reach::within says.
#pragma once

#include "compare/stages/truncate.hpp"
#include "fast/kernels/bound.hpp"
#include "fast/kernels/bvh.hpp"
#include "fast/kernels/control.hpp"
#include "fast/kernels/lists.hpp"
#include "fast/kernels/plane.hpp"

namespace ogc::fast {

/// The places of a pair's distance in the rows of its four vertices.
struct RowPlaces {
  int at[4];
};

/// Holds the arrays that the kernels of this file share.
struct PlaneListsView {
  SurfaceView surface;
  PaddedVecs positions{};                  ///< x at the detection
  const std::uint8_t* is_fixed = nullptr;  ///< by vertex
  float share = 0;                         ///< γ_p
  const Vec* displacement = nullptr;       ///< w by vertex [m], for ByApproach; null: both sides have half of each gap
  const float* query_radius = nullptr;     ///< r_q [m]
  NotedPair* noted = nullptr;              ///< pairs in any order; a pair's number is its place here
  float* distance = nullptr;               ///< by noted pair, rounded down [m]; infinity beyond r_q
  RowPlaces* places = nullptr;             ///< by noted pair
  int* pair_counts = nullptr;              ///< by vertex: number of its pairs
  int* pair_offsets = nullptr;             ///< vertices + 1
  float* pair_rows = nullptr;              ///< distances of vertex v's pairs [m] from pair_offsets[v] on, in any order
  float* threshold = nullptr;              ///< δ_v [m]
  float* nearest = nullptr;  ///< by vertex: lower bound of the distance of its nearest pair, at most r_q [m]
  /// by vertex: lower bound of the distance of its nearest pair without a plane, at most r_q [m]
  float* unplaned = nullptr;
  HalfSpace* placed = nullptr;        ///< half-spaces of vertex v from v · most_planes on, in any order
  NotedPair* placed_pairs = nullptr;  ///< the pair of each half-space in `placed`
  HalfSpace* rows = nullptr;  ///< half-spaces of each vertex in ascending order of pair; `pairs` holds their pairs
  NotedPair* pairs = nullptr;
  /// by vertex: distance within which the next search must note all of its pairs [m]; infinity: r_q
  float* search_limit = nullptr;
  float contact_radius = 0;  ///< r, with the contact margin [m]
  float* inner = nullptr;    ///< inner_radius by vertex [m]
  int* counts = nullptr;     ///< half-spaces by vertex, at most most_planes
  float* bound = nullptr;    ///< b_v by vertex [m]: γ_p times `unplaned`

  /// Returns whether the pair is a vertex and a facet; its first number is then ~vertex.
  OGC_HD bool is_vertex_facet(const NotedPair& pair) const { return pair.first < 0; }
  /// Returns noted pair i. MeasurePairs stored its second number inverted if the pair was certainly nearer than r.
  OGC_HD NotedPair pair(int i) const {
    const NotedPair raw = noted[i];
    return {raw.first, raw.second < 0 ? ~raw.second : raw.second};
  }
  /// Holds the vertices of a pair. The vertices from index `second_from` on are its second side.
  struct Vertices {
    int at[4], second_from;
  };
  OGC_HD Vertices vertices(const NotedPair& pair) const {
    if (is_vertex_facet(pair)) {
      const Facet& t = surface.facets[pair.second];
      return {{~pair.first, t.corner[0], t.corner[1], t.corner[2]}, 1};
    }
    const EdgeEnds p = surface.edges[pair.first], q = surface.edges[pair.second];
    return {{p.a, p.b, q.a, q.b}, 2};
  }
  /// Returns f(points) for the positions of a pair.
  template <class F>
  OGC_HD auto at_points(const NotedPair& pair, F f) const {
    const Vertices of = vertices(pair);
    const int* v = of.at;
    const PaddedVecs x = positions;
    const auto fixed = [this, v](int a, int b) { return is_fixed[v[a]] != 0 && is_fixed[v[b]] != 0; };
    if (of.second_from == 1)
      return f(PairPoints<1, 3>{{x[v[0]]}, {x[v[1]], x[v[2]], x[v[3]]}, fixed(0, 0), fixed(1, 2) && fixed(3, 3)});
    return f(PairPoints<2, 2>{{x[v[0]], x[v[1]]}, {x[v[2]], x[v[3]]}, fixed(0, 1), fixed(2, 3)});
  }
  /// Returns the displacements w of a pair's vertices; the second argument only selects the type.
  OGC_HD ByApproach<1, 3> approach(const NotedPair& pair, const PairPoints<1, 3>&) const {
    const Vertices of = vertices(pair);
    const Vec* w = displacement;
    return {{w[of.at[0]]}, {w[of.at[1]], w[of.at[2]], w[of.at[3]]}};
  }
  OGC_HD ByApproach<2, 2> approach(const NotedPair& pair, const PairPoints<2, 2>&) const {
    const Vertices of = vertices(pair);
    const Vec* w = displacement;
    return {{w[of.at[0]], w[of.at[1]]}, {w[of.at[2]], w[of.at[3]]}};
  }
  /// Returns the plane of a pair whose distance is at least `below`.
  OGC_HD PairPlane plane(const NotedPair& pair, float below) const {
    return at_points(pair, [this, &pair, below](const auto& points) {
      if (displacement == nullptr) return plane_of(points, below, share);
      return plane_of(points, below, share, approach(pair, points));
    });
  }
};

/// Raises `search_limit` of each vertex of a pair to the pair's distance at the new positions, if the pair was among
/// the vertex's N + 1 nearest pairs at the last detection. Runs once for each pair that the last detection noted.
struct LimitSearches {
  PlaneListsView lists;
  const Vec* positions;  ///< by vertex, of the next detection [m]

  OGC_HD void operator()(int i) const {
    const float below = lists.distance[i];
    const PlaneListsView::Vertices of = lists.vertices(lists.pair(i));
    bool is_near[4], is_any = false;
    for (int k = 0; k < 4; ++k) {
      const int v = of.at[k];
      const float threshold = lists.threshold[v];
      is_near[k] = lists.is_fixed[v] == 0 && threshold < infinity && below <= threshold;
      is_any = is_any || is_near[k];
    }
    if (!is_any) return;
    const Vec a = positions[of.at[0]], b = positions[of.at[1]], c = positions[of.at[2]], d = positions[of.at[3]];
    const Distance now = of.second_from == 1 ? point_triangle_distance(a, {b, c, d})
                                             : edge_edge_distance({a, b}, {c, d});
    const float above = round_up(add(now.value, now.slack));
    for (int k = 0; k < 4; ++k)
      if (is_near[k]) raise(&lists.search_limit[of.at[k]], above);
  }
};

/// Resets counts and `unplaned` before the pairs are measured; does nothing if there are no arrays. Runs once for each
/// vertex.
struct PreparePlanes {
  PlaneListsView lists;

  OGC_HD void operator()(int v) const {
    if (lists.counts == nullptr) return;
    lists.pair_counts[v] = lists.counts[v] = 0;
    lists.unplaned[v] = *lists.query_radius;
  }
};

/// Computes the distance of a noted pair, rounded down, and its places in the rows of its vertices. A pair that is
/// certainly not within r_q has an infinite distance. The second number of a pair that is certainly nearer than r is
/// inverted. Runs once for each noted pair.
struct MeasurePairs {
  PlaneListsView lists;

  OGC_HD void operator()(int i) const {
    const NotedPair pair = lists.pair(i);
    const PlaneListsView::Vertices of = lists.vertices(pair);
    RowPlaces places;  // first, so that computing the distance hides the latency of the atomics
    for (int k = 0; k < 4; ++k)
      places.at[k] = lists.is_fixed[of.at[k]] != 0 ? nowhere : atomic_add(&lists.pair_counts[of.at[k]], 1);
    lists.places[i] = places;
    const Distance d = lists.at_points(pair, [](const auto& points) { return distance_of(points); });
    lists.distance[i] = d.may_be_within(*lists.query_radius) ? d.below() : infinity;
    if (d.is_surely_within(lists.contact_radius)) lists.noted[i].second = ~pair.second;
  }

  /// Place of a fixed vertex, which has no row.
  static constexpr int nowhere = -1;
};

/// Enters the distance of each pair in the rows of its vertices. Runs once for each noted pair.
struct FillPairRows {
  PlaneListsView lists;

  OGC_HD void operator()(int i) const {
    const RowPlaces places = lists.places[i];
    const PlaneListsView::Vertices of = lists.vertices(lists.pair(i));
    const float below = lists.distance[i];
    for (int k = 0; k < 4; ++k)
      if (places.at[k] != MeasurePairs::nowhere) lists.pair_rows[lists.pair_offsets[of.at[k]] + places.at[k]] = below;
  }
};

/// Writes δ_v and the smallest distance of a vertex. δ_v is the (N+1)-th smallest distance of its row; it is infinity
/// if the row has at most N distances. Runs once for each row.
struct ChooseThreshold {
  static constexpr int rank = most_planes;
  PlaneListsView lists;

  OGC_HD void operator()(int v, float nearest, float after_rank) const {
    lists.nearest[v] = smaller(nearest, *lists.query_radius);
    lists.threshold[v] = after_rank;
  }
};

/// Places the plane of a pair if the pair is nearer than δ_v for each of its movable vertices, and if its points pass
/// the test of plane_of. Otherwise the pair's distance lowers `unplaned` of its vertices. Runs once for each noted
/// pair.
struct PlacePlanes {
  PlaneListsView lists;

  OGC_HD void operator()(int i) const {
    const float below = lists.distance[i];
    const NotedPair pair = lists.pair(i);
    const PlaneListsView::Vertices of = lists.vertices(pair);
    bool moves[4], is_near = true;
    for (int k = 0; k < 4; ++k) {
      moves[k] = lists.is_fixed[of.at[k]] == 0;
      is_near = is_near && (!moves[k] || below < lists.threshold[of.at[k]]);
    }
    const PairPlane plane = is_near ? lists.plane(pair, below) : PairPlane{};
    for (int k = 0; k < 4; ++k) {
      const int v = of.at[k];
      if (!moves[k]) continue;
      if (!plane.exists()) {
        lower(&lists.unplaned[v], below);
        continue;
      }
      // fits into the row, because at most N pairs are nearer than δ_v
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(v) * most_planes + atomic_add(&lists.counts[v], 1);
      lists.placed[at] = k < of.second_from ? plane.of_first() : plane.of_second();
      lists.placed_pairs[at] = pair;
    }
  }
};

/// Moves each plane to its place in ascending order of pairs; the thread of place 0 also writes the ball's radius and
/// the inner radius. Runs once for each of the N places of each vertex.
struct SortHalfSpaces {
  PlaneListsView lists;

  OGC_HD void operator()(int i) const {
    const int v = i / most_planes, k = i % most_planes, count = lists.counts[v];
    if (k == 0)
      lists.bound[v] = lists.surface.is_off_surface(v)
                           ? largest_float
                           : round_down(mul(static_cast<double>(lists.share), static_cast<double>(lists.unplaned[v])));
    if (k == 0) lists.search_limit[v] = lists.is_fixed[v] != 0 || lists.threshold[v] < infinity ? 0.0F : infinity;
    if (k == 0) lists.inner[v] = inner_radius(lists.placed + i, count, lists.positions[v]);
    if (k >= count) return;
    const NotedPair own = lists.placed_pairs[i];
    int before = 0;
    for (int other = 0; other < count; ++other) before += comes_before(lists.placed_pairs[i - k + other], own) ? 1 : 0;
    lists.rows[i - k + before] = lists.placed[i];
    lists.pairs[i - k + before] = own;
  }

 private:
  OGC_HD bool comes_before(const NotedPair& a, const NotedPair& b) const {
    if (lists.is_vertex_facet(a) != lists.is_vertex_facet(b)) return lists.is_vertex_facet(a);
    const int first = a.first < 0 ? ~a.first : a.first, other = b.first < 0 ? ~b.first : b.first;
    return first != other ? first < other : a.second < b.second;
  }
};

}  // namespace ogc::fast
