// From the pairs within r_q that a search noted to each vertex's half-spaces and ball (method.md §5.6):
//
//   MeasurePairs     by pair    its distance; how many pairs each vertex has
//   (scan of these numbers)
//   FillPairRows     by pair    into the rows of its vertices, in any order
//   ChooseThreshold  by vertex  δ_v, the (N+1)-th smallest distance of its pairs
//   PlacePlanes      by pair    nearer than δ_v of all its vertices it gets a plane; any other limits their balls
//   WriteHalfSpaces  by vertex  its planes in ascending order of pair, at most N; the ball
//
// Nothing depends on the order in which pairs were noted: rows are sorted, thresholds and balls are minima. Fixed
// vertices bear no plane and have no row.
#pragma once

#include "fast/kernels/bound.hpp"
#include "fast/kernels/control.hpp"
#include "fast/kernels/lists.hpp"
#include "fast/kernels/plane.hpp"

namespace ogc::fast {

/// Counts a prescribed vertex that did not reach its target.
OGC_HD inline void count_behind(StepControl& control, const Truncated& kept, const Vec& previous,
                                const FeasibleRegions& regions) {
  if (!kept.cut) return;
  const Vec &x = kept.position, &p = previous;
  if (!regions.has_planes())
    control.count_cut();
  else
    control.count_lag(x.x != p.x || x.y != p.y || x.z != p.z);
}

/// A pair in the row of a vertex, with its distance: rows are read in one stream, and those of collapsed spots are
/// long.
struct RowPair {
  int number = 0;   ///< of the noted pair
  float below = 0;  ///< its distance, rounded down [m]
};

/// What the kernels of this file share.
struct PlaneListsView {
  SurfaceView surface;
  PaddedVecs positions;                    ///< of the detection
  const std::uint8_t* is_fixed = nullptr;  ///< by vertex
  float share = 0;                         ///< γ_p
  const Vec* displacement = nullptr;       ///< w by vertex [m], which divides gaps; null: they are halved
  const float* query_radius = nullptr;     ///< r_q [m]
  const NotedPair* noted = nullptr;        ///< pairs within r_q in any order, numbered by their place
  PairPlane* planes = nullptr;             ///< by noted pair
  int* pair_counts = nullptr;              ///< by vertex: pairs that it is part of
  int* pair_offsets = nullptr;             ///< vertices + 1
  int* pair_filled = nullptr;              ///< by vertex
  RowPair* pair_rows = nullptr;            ///< a vertex's pairs, in any order: from pair_offsets[v]
  float* threshold = nullptr;              ///< δ_v [m]
  float* nearest = nullptr;                ///< by vertex: not above the distance of its nearest pair, at most r_q [m]
  float* unplaned = nullptr;               ///< the same of its nearest pair without a plane
  HalfSpace* rows = nullptr;               ///< n·x ≤ o of vertex v from v · most_planes, in ascending order of pair
  NotedPair* pairs = nullptr;              ///< beside the rows: whose planes they are
  int* counts = nullptr;                   ///< half-spaces by vertex, at most most_planes
  float* bound = nullptr;                  ///< b_v by vertex [m]: γ_p times `unplaned`

  /// Such a pair is stored as ~vertex and facet.
  OGC_HD bool is_vertex_facet(const NotedPair& pair) const { return pair.first < 0; }
  /// A search stores the second number inverted where it is certain of something else.
  OGC_HD NotedPair pair(int i) const {
    const NotedPair raw = noted[i];
    return {raw.first, raw.second < 0 ? ~raw.second : raw.second};
  }
  /// The vertices of a pair; those from `second_from` on belong to the second side.
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
  /// f(v) for each vertex that can move.
  template <class F>
  OGC_HD void for_each_moving(const NotedPair& pair, F f) const {
    const Vertices of = vertices(pair);
    for (int k = 0; k < 4; ++k)
      if (is_fixed[of.at[k]] == 0) f(of.at[k]);
  }
  /// f of the PairPoints of a pair.
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
  /// The displacements of a pair, as its points.
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
  /// The plane of a pair that is not nearer than `below`.
  OGC_HD PairPlane plane(const NotedPair& pair, float below) const {
    return at_points(pair, [this, &pair, below](const auto& points) {
      if (displacement == nullptr) return plane_of(points, below, share);
      return plane_of(points, below, share, approach(pair, points));
    });
  }
};

/// for_each over vertices, before MeasurePairs.
struct PreparePlanes {
  PlaneListsView lists;

  OGC_HD void operator()(int v) const {
    lists.pair_counts[v] = lists.pair_filled[v] = 0;
    lists.nearest[v] = lists.unplaned[v] = *lists.query_radius;
  }
};

/// for_each_counted over noted pairs: their distances, rounded down, and the number of pairs and the smallest distance
/// of each vertex.
struct MeasurePairs {
  PlaneListsView lists;

  OGC_HD void operator()(int i) const {
    const NotedPair pair = lists.pair(i);
    const float below = lists.at_points(pair, [](const auto& points) { return distance_of(points).below(); });
    lists.planes[i] = {{}, below};
    lists.for_each_moving(pair, [&](int v) {
      atomic_add(&lists.pair_counts[v], 1);
      lower(&lists.nearest[v], below);
    });
  }
};

/// for_each_counted over noted pairs: enters each in the rows of its vertices.
struct FillPairRows {
  PlaneListsView lists;

  OGC_HD void operator()(int i) const {
    const RowPair entry{i, lists.planes[i].below};
    lists.for_each_moving(lists.pair(i), [&](int v) {
      lists.pair_rows[lists.pair_offsets[v] + atomic_add(&lists.pair_filled[v], 1)] = entry;
    });
  }
};

/// for_each over vertices: δ_v, infinite where there are at most N pairs.
struct ChooseThreshold {
  PlaneListsView lists;

  OGC_HD void operator()(int v) const {
    float nearest[most_planes + 1];  // ascending
    for (float& d : nearest) d = __builtin_huge_valf();
    for (int k = lists.pair_offsets[v]; k < lists.pair_offsets[v + 1]; ++k) {
      float d = lists.pair_rows[k].below;
      if (!(d < nearest[most_planes])) continue;
      for (float& other : nearest) {
        const float nearer = smaller(d, other);
        d = larger(d, other);
        other = nearer;
      }
    }
    lists.threshold[v] = nearest[most_planes];
  }
};

/// for_each_counted over noted pairs: the plane, where the pair is nearer than δ_v of all vertices that can move and
/// the points keep what is computed; otherwise the pair's distance lowers `unplaned` of its vertices.
struct PlacePlanes {
  PlaneListsView lists;

  OGC_HD void operator()(int i) const {
    PairPlane& plane = lists.planes[i];
    const NotedPair pair = lists.pair(i);
    bool is_near = true;
    lists.for_each_moving(pair, [&](int v) { is_near = is_near && plane.below < lists.threshold[v]; });
    if (is_near) plane = lists.plane(pair, plane.below);
    if (plane.exists()) return;
    lists.for_each_moving(pair, [&](int v) { lower(&lists.unplaned[v], plane.below); });
  }
};

/// for_each over vertices: the rows of half-spaces, their numbers and the balls.
struct WriteHalfSpaces {
  PlaneListsView lists;

  OGC_HD void operator()(int v) const {
    int place[most_planes], count = 0;
    const float threshold = lists.threshold[v];
    for (int k = lists.pair_offsets[v]; k < lists.pair_offsets[v + 1]; ++k) {
      const RowPair entry = lists.pair_rows[k];
      if (!(entry.below < threshold)) continue;  // nobody placed a plane there
      const int i = entry.number;
      if (!lists.planes[i].exists()) continue;
      int at = count++;
      for (; at > 0 && comes_before(i, place[at - 1]); --at) place[at] = place[at - 1];
      place[at] = i;
    }
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(v) * most_planes;
    for (int k = 0; k < count; ++k) {
      lists.rows[row + k] = half_space(place[k], v);
      lists.pairs[row + k] = lists.pair(place[k]);
    }
    lists.counts[v] = count;
    lists.bound[v] = lists.surface.is_off_surface(v)
                         ? largest_float
                         : round_down(mul(static_cast<double>(lists.share), static_cast<double>(lists.unplaned[v])));
  }

 private:
  OGC_HD bool comes_before(int i, int j) const {
    const NotedPair a = lists.pair(i), b = lists.pair(j);
    if (lists.is_vertex_facet(a) != lists.is_vertex_facet(b)) return lists.is_vertex_facet(a);
    const int first = a.first < 0 ? ~a.first : a.first, other = b.first < 0 ? ~b.first : b.first;
    return first != other ? first < other : a.second < b.second;
  }
  OGC_HD HalfSpace half_space(int i, int v) const {
    const NotedPair pair = lists.pair(i);
    const PairPlane plane = lists.planes[i];
    const auto of = lists.vertices(pair);
    const bool is_of_first = of.at[0] == v || (of.second_from == 2 && of.at[1] == v);
    return is_of_first ? plane.of_first() : plane.of_second();
  }
};

}  // namespace ogc::fast
