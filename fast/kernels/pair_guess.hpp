// The guess by certificate of pairs (guess=pairs; compare/pair_guess.md). Moves w = y − X begin whole; pairs that are
// too near one another for the moves of their sides scale them, for some passes; what that does not settle is cut to
// its ball, and again, until no pair is unsafe. A pair is safe if its vertices stay in their balls, if no two moves of
// its sides differ by 2γ_p d, or if its gap along n, the normal between its closest points at X, shrinks by no more
// than 2γ_p of itself. All of this is decided on stored positions; every change lies on the way from X to y, coordinate
// by coordinate, as rounding is monotone. So pairs farther apart than what the moves of their own vertices allow need
// not be listed.
#pragma once

#include "fast/kernels/bound.hpp"
#include "fast/kernels/control.hpp"
#include "fast/kernels/near_pairs.hpp"
#include "fast/kernels/plane_lists.hpp"

namespace ogc::fast {

/// Passes that scale moves before vertices are cut to their balls.
inline constexpr int scaling_passes = 8;
/// A contact that scaling leaves keeps half of r; one that is nearer may lose this share of its gap, so that rounding
/// does not stop what moves together.
inline constexpr double pressed_share = 0x1p-4;
/// What is asked for is less than what is allowed by this share, so that no rounding of it matters.
inline constexpr double pair_guess_slack = 0x1p-20;

/// A guess on the backend.
struct PairGuessState {
  int below[3] = {}, above[3] = {};  ///< bits of floats: how far moves lead below and above 0, by coordinate [m]
  float reach = 0;                   ///< R: no pair beyond can meet [m]
  float longest = 0;                 ///< of a move; longer ones are cut to it [m]
  int pass = 0;                      ///< passes done
};

/// y − X in double, which loses at most 2⁻⁵³ of it.
OGC_HD inline Vector<double> move_of(const Vec& from, const Vec& to) {
  return {sub(static_cast<double>(to.x), static_cast<double>(from.x)),
          sub(static_cast<double>(to.y), static_cast<double>(from.y)),
          sub(static_cast<double>(to.z), static_cast<double>(from.z))};
}

/// What kernels share.
struct PairGuessView {
  PlaneListsView lists;         ///< surface, X, is_fixed, γ_p, noted pairs
  PairPlane* planes = nullptr;  ///< by noted pair: what is known of it
  FeasibleRegions regions;
  const Vec* target = nullptr;      ///< y by vertex [m]
  Vec* way = nullptr;               ///< by vertex: where its move leads at most [m]
  Vec* position = nullptr;          ///< x by vertex [m]
  float* share = nullptr;           ///< by vertex: of the way, now
  float* next = nullptr;            ///< by vertex: of the way, after this pass
  int* unsafe = nullptr;            ///< by vertex: not 0 where it is part of an unsafe pair
  float contact_radius = 0;         ///< r [m]
  float largest_reach = 0;          ///< of R: the cap of r_q [m]
  PairGuessState* state = nullptr;  ///< on the backend
  StepControl* control = nullptr;   ///< on the backend

  /// 2γ_p and a little less.
  OGC_HD double allowed() const { return mul(mul(2, static_cast<double>(lists.share)), 1 - pair_guess_slack); }
};

/// First of all: y may lead many vertices out of their balls, or the guess of balls stands.
struct BeginPairGuess {
  StepControl* control;
  ControlSettings settings;
  PairGuessState* state;

  OGC_HD void operator()(int) const {
    StepControl& c = *control;
    c.pairs = c.unsafe = c.left = 0;
    *state = {};
    if (c.attempted == 0) return;
    ++c.rounds;
    c.pairs = take_request(c, settings.pair_guess_count) && c.active != 0 ? 1 : 0;
  }
};

/// for_each over vertices: the box of all moves.
struct SpanMoves {
  PairGuessView view;

  OGC_HD void operator()(int v) const {
    if (view.lists.surface.is_off_surface(v)) return;
    const Vector<double> w = move_of(view.lists.positions[v], view.target[v]);
    const double part[3] = {w.x, w.y, w.z};
    for (int k = 0; k < 3; ++k) {
      atomic_max(&view.state->above[k], float_bits(round_up(larger(part[k], 0.0))));
      atomic_max(&view.state->below[k], float_bits(round_up(larger(-part[k], 0.0))));
    }
  }
};

/// R from the diagonal of that box, which no difference of two moves or shares of moves exceeds.
struct ChooseReach {
  PairGuessView view;

  OGC_HD void operator()(int) const {
    PairGuessState& s = *view.state;
    double squared = 0;
    for (int k = 0; k < 3; ++k) {
      const double side = add(static_cast<double>(float_from_bits(s.above[k])),
                              static_cast<double>(float_from_bits(s.below[k])));
      squared = add(squared, mul(side, side));
    }
    const double reach = divide(square_root(squared), view.allowed());
    const bool fits = reach <= static_cast<double>(view.largest_reach);
    s.reach = fits ? round_up(reach) : view.largest_reach;
    s.longest = fits ? largest_float
                     : round_down(mul(mul(0.5, view.allowed()), static_cast<double>(view.largest_reach)));
  }
};

/// for_each over vertices: whole moves, or what R leaves of them.
struct BeginMoves {
  PairGuessView view;

  OGC_HD void operator()(int v) const {
    const float longest = view.state->longest;
    const bool is_whole = longest == largest_float || view.lists.surface.is_off_surface(v);
    const Vec to = is_whole ? view.target[v] : truncate({view.lists.positions[v], longest}, view.target[v]).position;
    view.way[v] = view.position[v] = to;
    view.share[v] = view.next[v] = 1;
    view.unsafe[v] = 0;
  }
};

/// What of a pair its own moves allow: beyond it cannot meet.
struct LocalReach {
  const Vec* way;    ///< by vertex: where its move leads at most [m]
  PaddedVecs start;  ///< X by vertex [m]
  double allowed;    ///< see PairGuessView

  /// The squared limit of the diagonal of the box of these moves and 0.
  template <int n>
  OGC_HD float limit(const int (&vertices)[n]) const {
    Vector<double> low{}, high{};
    for (const int v : vertices) {
      const Vector<double> w = move_of(start[v], way[v]);
      low = {smaller(low.x, w.x), smaller(low.y, w.y), smaller(low.z, w.z)};
      high = {larger(high.x, w.x), larger(high.y, w.y), larger(high.z, w.z)};
    }
    const Vector<double> side{sub(high.x, low.x), sub(high.y, low.y), sub(high.z, low.z)};
    const double squared = add(add(mul(side.x, side.x), mul(side.y, side.y)), mul(side.z, side.z));
    return gap_limit(round_up(divide(square_root(squared), allowed)));
  }
};

/// The searches of all vertices; a Query of search.hpp.
struct GuessVertexFacet : NearVertexFacet {
  LocalReach local;

  /// As of NearVertexFacet, and no more than what the pair's own moves allow.
  OGC_HD float candidate_limit(const Search& search, const Offer& offer) const {
    if (surface.is_off_surface(search.owner)) return -1.0F;
    const float near = NearVertexFacet::candidate_limit(search, offer);
    if (near < 0) return near;
    const int* corner = surface.facets[offer.primitive].corner;
    const float own = local.limit({search.owner, corner[0], corner[1], corner[2]});
    return offer.gap > own ? -1.0F : smaller(near, own);
  }
  /// As of NearVertexFacet.
  OGC_HD bool is_pair(const Search& search, const Offer& offer) const {
    const float within = candidate_limit(search, offer);
    return !(within < 0) && !is_beyond(separation(search.box.lower, corners(surface.facets[offer.primitive])), within);
  }
};

/// The searches of all edges, likewise.
struct GuessEdgeEdge : NearEdgeEdge {
  LocalReach local;

  /// As of GuessVertexFacet.
  OGC_HD float candidate_limit(const Search& search, const Offer& offer) const {
    const float near = NearEdgeEdge::candidate_limit(search, offer);
    if (near < 0) return near;
    const EdgeEnds p = surface.edges[search.owner], q = surface.edges[offer.primitive];
    const float own = local.limit({p.a, p.b, q.a, q.b});
    return offer.gap > own ? -1.0F : smaller(near, own);
  }
  /// As of GuessVertexFacet.
  OGC_HD bool is_pair(const Search& search, const Offer& offer) const {
    const float within = candidate_limit(search, offer);
    return !(within < 0) &&
           !is_beyond(separation(ends(surface.edges[search.owner]), ends(surface.edges[offer.primitive])), within);
  }
};

/// After the searches: pairs that found no room end the step.
struct EndPairSearch {
  StepControl* control;
  ListsView lists;

  OGC_HD void operator()(int) const {
    if (*lists.noted_count > lists.noted_capacity) *lists.overflow = 1;
    if (*lists.overflow == 0) return;
    control->status |= compare::step_list_grew;
    stop_if_failed(*control);
  }
};

/// Nothing is known of a listed pair yet. for_each_counted over noted pairs.
struct ForgetPairs {
  PairPlane* planes;

  OGC_HD void operator()(int i) const { planes[i] = {{}, unknown}; }

  static constexpr float unknown = -1;  ///< in place of a distance
};

/// for_each_counted over noted pairs: an unsafe pair scales the moves of its vertices, or marks them.
struct CheckPair {
  PairGuessView view;

  OGC_HD void operator()(int i) const {
    if (view.control->active == 0) return;
    const NotedPair pair = view.lists.pair(i);
    const PlaneListsView::Vertices of = view.lists.vertices(pair);
    const double share = safe_share(i, pair, of);
    if (share >= 1) return;
    atomic_max(&view.control->unsafe_seen, 1);
    const bool scales = view.state->pass < scaling_passes;
    for (const int v : of.at) {
      if (scales)
        lower(&view.next[v], round_down(mul(static_cast<double>(view.share[v]), mul(share, 1 - 0x1p-6))));
      else
        atomic_max(&view.unsafe[v], 1);
    }
  }

 private:
  /// 1 where the pair is safe, otherwise the share of its moves that would be. Passes that scale ask for more.
  OGC_HD double safe_share(int i, const NotedPair& pair, const PlaneListsView::Vertices& of) const {
    Vector<double> move[4];
    bool is_inside = true;
    for (int k = 0; k < 4; ++k) {
      const Vec start = view.lists.positions[of.at[k]], x = view.position[of.at[k]];
      move[k] = move_of(start, x);
      is_inside = is_inside && is_within(view.regions.ball(of.at[k]), x);
    }
    if (is_inside) return 1;
    const double apart = largest_difference(move, of.second_from);
    if (!(apart > 0)) return 1;
    PairPlane& known = view.planes[i];
    if (known.below < 0) known.below = view.lists.at_points(pair, [](const auto& p) { return distance_of(p).below(); });
    const double by_distance = divide(room(static_cast<double>(known.below)), apart);
    if (by_distance > 1) return 1;
    if (!known.exists())
      known = view.lists.at_points(
          pair, [&known, share = view.lists.share](const auto& p) { return plane_of(p, known.below, share); });
    return known.exists() ? larger(by_distance, share_along(known.normal, of)) : by_distance;
  }

  /// By how much a gap may shrink: a little less than 2γ_p of it; while moves are scaled to half of r at most, or by a
  /// small share of it.
  OGC_HD double room(double gap) const {
    const double safe = mul(view.allowed(), gap);
    if (view.state->pass >= scaling_passes) return safe;
    return smaller(safe, larger(sub(gap, mul(0.5, static_cast<double>(view.contact_radius))), mul(pressed_share, gap)));
  }

  /// No less than ‖w_i − w_j‖ of any two vertices of the two sides: six roundings of 2⁻⁵³ each, and those of the moves.
  OGC_HD static double largest_difference(const Vector<double> (&move)[4], int second_from) {
    double largest = 0;
    for (int a = 0; a < second_from; ++a)
      for (int b = second_from; b < 4; ++b) {
        const double x = sub(move[a].x, move[b].x), y = sub(move[a].y, move[b].y), z = sub(move[a].z, move[b].z);
        largest = larger(largest, add(add(mul(x, x), mul(y, y)), mul(z, z)));
      }
    return mul(square_root(largest), 1 + 0x1p-40);
  }

  /// Heights n·x are off by 2⁻⁵² of their size each (feasible_region.hpp), so a gap by less than 2⁻⁵⁰ of all sizes.
  OGC_HD double share_along(const Vec& n, const PlaneListsView::Vertices& of) const {
    constexpr double nothing = __builtin_huge_val();
    double top[2] = {-nothing, -nothing}, bottom[2] = {nothing, nothing}, size = 0;
    for (int k = 0; k < 4; ++k) {
      const Excess height[2] = {excess(n, 0, view.lists.positions[of.at[k]]), excess(n, 0, view.position[of.at[k]])};
      for (int time = 0; time < 2; ++time) {
        const double h = height[time].value;
        if (k < of.second_from)
          top[time] = larger(top[time], h);
        else
          bottom[time] = smaller(bottom[time], h);
        size = add(size, height[time].size);
      }
    }
    const double error = mul(0x1p-50, size), before = sub(bottom[0], top[0]), after = sub(bottom[1], top[1]);
    const double shrunk = add(sub(before, after), error), least = sub(before, error);
    if (!(least > 0)) return 0;
    return shrunk <= room(least) ? 1 : divide(room(least), shrunk);
  }
};

/// for_each over vertices, after a pass: the moves that it asked for.
struct ScaleMove {
  PairGuessView view;

  OGC_HD void operator()(int v) const {
    const Vec start = view.lists.positions[v];
    if (view.unsafe[v] != 0) {
      view.unsafe[v] = 0;
      view.position[v] = truncate(view.regions.ball(v), view.position[v]).position;
    }
    const float share = view.next[v];
    if (!(share < view.share[v])) return;
    view.share[v] = share;
    const Vector<double> w = move_of(start, view.way[v]);
    const auto part = [share](float from, double whole) {
      return static_cast<float>(add(static_cast<double>(from), mul(static_cast<double>(share), whole)));
    };
    view.position[v] = {part(start.x, w.x), part(start.y, w.y), part(start.z, w.z)};
  }
};

/// Whether another pass is due. `first`: before the first, which is.
struct EndPass {
  StepControl* control;
  PairGuessState* state;
  bool first = false;

  OGC_HD void operator()(int) const {
    StepControl& c = *control;
    if (!first) ++state->pass;
    c.unsafe = c.active != 0 && c.pairs != 0 && (first || c.unsafe_seen != 0) ? 1 : 0;
    c.unsafe_seen = 0;
  }
};

/// for_each over vertices, at the end: who is not at y.
struct CountMoves {
  PairGuessView view;
  const int* prescribed_number;  ///< as in BeginVertex

  OGC_HD void operator()(int v) const {
    StepControl& c = *view.control;
    if (c.pairs == 0 || c.active == 0) return;
    const Vec x = view.position[v], y = view.target[v];
    if (prescribed_number[v] != -2 && (x.x != y.x || x.y != y.y || x.z != y.z)) c.count_cut();
  }
};

/// After a guess by pairs a detection is due before the first iteration: vertices may be outside of their balls, and
/// pairs of the guess stand in the list where contacts are noted.
struct EndPairGuess {
  StepControl* control;

  OGC_HD void operator()(int) const {
    StepControl& c = *control;
    if (c.pairs == 0) return;
    c.left = c.active;
    c.cut_last = c.cut;
    c.cut = 0;
  }
};

}  // namespace ogc::fast
