// A Verlet list, that is a list of pairs with a skin: as long as no vertex has moved far since a search, the pairs that
// can matter are among those that this search met within a margin, and a detection looks at these instead of searching
// the trees. Sets, smallest distances and bounds are the same bits (tests/fast/stages/skin.cpp).
//
// Let m be the margin, δ the largest displacement since the search ("the anchor"), D the smallest distance of a
// primitive then, as stored: at most ε below the exact one. A listing search keeps every pair not farther than max(r,
// D) + m, for the D of either partner. Distances change by at most 2δ. So
//   now the smallest distance of a primitive is at most D + 2δ + ε, and the pair that has it was then no farther
//   than D + 4δ + ε;
//   a pair that is nearer than r now was then nearer than r + 2δ;
//   a primitive without a pair within r_q then (D = r_q) has now none nearer than r_q', r_q' ≤ r_q + m/2,
//   that was farther than r_q + m/2 + 2δ.
// With δ ≤ 7m/32 and ε ≤ m/32 all of these are within the list, and what is not in it is farther now than D + 2δ + m/8.
// ε is two slacks of at most 2⁻²³ S (closest_face.hpp, closest_points.hpp) and a rounding, S ≤ 18 X with X the largest
// coordinate: under 2⁻¹⁷ X.
#pragma once

#include "fast/kernels/control.hpp"
#include "fast/kernels/lists.hpp"
#include "fast/kernels/segment.hpp"

namespace ogc::fast {

/// Largest m as a fraction of r: a list outlives displacements of up to 7/32 of m, and grows with it
/// (fast/PERFORMANCE.md).
inline constexpr float usual_skin = 1.0F;

/// What a detection does: search the trees; also keep the pairs within the margin; look at the kept pairs.
enum class SkinMode : int { search, list, recheck };

/// What the device knows of its list.
struct SkinState {
  SkinMode mode = SkinMode::search;  ///< of this detection
  int has_anchor = 0, has_list = 0;  ///< 1 once a search has left its positions; 1 while there is a list made at them
  int drift = 0, extent = 0;         ///< bits of δ and X of this detection [m]
  float margin = 0;                  ///< m of the list [m]
  float listed_radius = 0;           ///< r_q of the anchor [m]
  float contact_radius = 0;          ///< r of the list [m]
  float bound = 0;                   ///< 2δ + m/16: with it D is above the smallest distance now [m]
  int count = 0, most = 0;  ///< pairs kept, also those that found no room; the most of any list before this one
  int searches = 0, listings = 0, rechecks = 0;  ///< detections of each mode so far
  /// uses of this list; searches without one after a list that nothing used, and how many are left
  int rechecks_of_list = 0, patience = 0, wait = 0;
};

/// The list on the backend.
struct SkinView {
  SkinState* state = nullptr;  ///< on the backend
  float largest_margin = 0;    ///< of m [m]; 0: no list is ever made
  float contact_radius = 0;    ///< r [m]: pairs that were kept for another one are of no use
  NotedPair* pairs = nullptr;  ///< pairs within the margin, in any order
  int capacity = 0;            ///< of `pairs`; a list that found more than this is not used
  Vec* anchor = nullptr;       ///< x by vertex at the search that the list is measured against [m]
  float *vertex = nullptr, *edge = nullptr, *triangle = nullptr;  ///< D of the anchor [m]

  /// Whether the list takes the place of a search.
  OGC_HD bool rechecks() const { return state->mode == SkinMode::recheck; }
  /// By which a search looks farther.
  OGC_HD float search_margin() const { return state->mode == SkinMode::list ? state->margin : 0.0F; }

  /// Adds a pair; counts it also where there is no room.
  OGC_HD void keep(const NotedPair& pair) const {
    const int place = atomic_add(&state->count, 1);
    if (place < capacity) pairs[place] = pair;
  }

  /// Not below the smallest distance now of a primitive whose D was `anchored`; infinite where that was no distance of
  /// a pair.
  OGC_HD float bound(float anchored) const {
    return anchored < state->listed_radius ? add(anchored, state->bound) : __builtin_huge_valf();
  }
};

/// Whether a detection needs its trees; null: one that keeps no pairs.
OGC_HD inline bool needs_trees(const SkinState* skin) { return skin == nullptr || skin->mode != SkinMode::recheck; }

/// What is no number counts as infinite.
OGC_HD inline void raise_bits(int* target, float value) {
  raise_together(target, float_bits(value >= 0 ? value : __builtin_huge_valf()));
}

/// for_each over vertices: raises δ, the largest displacement since the search, and X, the largest coordinate.
struct MeasureDrift {
  SkinView skin;
  const Vec* positions;  ///< of this detection, by vertex [m]
  const int* overflow;   ///< on the backend; not 0: nothing is measured

  OGC_HD void operator()(int v) const {
    if (*overflow != 0) return;
    const Vec x = positions[v];
    raise_bits(&skin.state->extent, larger(larger(fabsf(x.x), fabsf(x.y)), fabsf(x.z)));
    if (skin.state->has_anchor != 0)
      raise_bits(&skin.state->drift, round_up(square_root(squared(difference<Rounded>(x, skin.anchor[v])))));
  }
};

/// After MeasureDrift, one item: the mode of this detection. A list costs about as much as a second search, so it is
/// made only where the next three detections can use it: m is chosen for six of them, at the displacement since the
/// search before this detection. After each list in a row that nothing could use, twice as many searches are made
/// without one.
struct ChooseSkinMode {
  /// Share of m that δ may reach: a list then still holds all that matters (head of this file).
  static constexpr float drift_of_margin = 0x7p-5F;

  SkinView skin;
  const float* query_radius;  ///< r_q of this detection [m], on the backend
  const int* overflow;        ///< on the backend; not 0: the mode stays

  OGC_HD void operator()(int) const {
    if (*overflow != 0) return;
    SkinState& s = *skin.state;
    const float drift = float_from_bits(s.drift), extent = float_from_bits(s.extent);
    s.drift = s.extent = 0;
    const bool is_listed = s.has_list != 0 && s.contact_radius == skin.contact_radius && s.count <= skin.capacity &&
                           *query_radius <= add(s.listed_radius, mul(0.5F, s.margin));
    if (is_listed && drift <= mul(drift_of_margin, s.margin) && is_wide_enough(s.margin, extent)) {
      s.mode = SkinMode::recheck;
      s.bound = add(mul(2.0F, drift), mul(s.margin, 0x1p-4F));
      ++s.rechecks, ++s.rechecks_of_list;
      return;
    }
    if (s.has_list != 0) s.most = s.count > s.most ? s.count : s.most;
    if (s.has_list != 0) s.patience = s.wait = s.rechecks_of_list > 0 ? 0 : (s.patience < 31 ? 2 * s.patience + 1 : 63);
    const float least = larger(mul(skin.largest_margin, 0x1p-3F), mul(extent, 0x1p-12F)),
                wanted = larger(least, drift * (6 / drift_of_margin));
    const float margin = smaller(skin.largest_margin, wanted);
    const bool lists = s.wait == 0 && s.has_anchor != 0 && margin > 0 && drift * (3 / drift_of_margin) <= margin &&
                       is_wide_enough(margin, extent);
    if (s.wait > 0) --s.wait;
    s.mode = lists ? SkinMode::list : SkinMode::search;
    s.rechecks_of_list = 0;
    s.margin = margin;
    s.has_anchor = 1;
    s.has_list = lists ? 1 : 0;
    s.listed_radius = *query_radius;
    s.contact_radius = skin.contact_radius;
    s.count = 0;
    ++(lists ? s.listings : s.searches);
  }

 private:
  /// ε ≤ m/32.
  OGC_HD static bool is_wide_enough(float margin, float extent) {
    return mul(extent, 0x1p-17F) <= mul(margin, 0x1p-5F);
  }
};

/// After a search: for_each over the most numerous of vertices, edges and triangles.
struct KeepAnchor {
  SkinView skin;
  SurfaceView surface;
  const Vec* positions;                                     ///< of the search, by vertex [m]
  const float *d_min_vertex, *d_min_edge, *d_min_triangle;  ///< of the search, by vertex, edge and triangle [m]

  OGC_HD void operator()(int i) const {
    if (skin.rechecks()) return;
    if (i < surface.vertex_count) skin.anchor[i] = positions[i];
    if (skin.state->mode != SkinMode::list) return;
    if (i < surface.vertex_count) skin.vertex[i] = d_min_vertex[i];
    if (i < surface.edge_count) skin.edge[i] = d_min_edge[i];
    if (i < surface.triangle_count) skin.triangle[i] = d_min_triangle[i];
  }
};

}  // namespace ogc::fast
