// Updates the vertices in an iteration (Alg. 4). A free vertex sums its forces and blocks (gather.hpp), solves a 3×3
// system, truncates the result and writes it. A prescribed vertex moves towards its target. update_segment.hpp updates
// the segments of rods.
#pragma once

#include <cmath>
#include <limits>

#include "fast/kernels/arithmetic/solve3.hpp"
#include "fast/kernels/held.hpp"
#include "fast/kernels/inertia.hpp"
#include "fast/kernels/sweep/gather.hpp"

namespace ogc::fast {

/// Truncates the proposal to the vertex's region. The leader writes the position, counts a cut and returns the
/// position; other threads return `stay`. If the proposal is not finite, the vertex stays and the step fails. All
/// threads for which holds_total() is true must call this together.
template <class Metric, class Team>
OGC_HD Vec write_held(const SweepView& view, int v, const Vec& proposal, const Vec& stay, const FeasibleRegion& region,
                      const Metric& metric, const Team& team) {
  const bool may_be_written = is_finite(proposal);
  const Truncated kept = may_be_written ? held(region, stay, proposal, metric, team) : Truncated{stay, false};
  if (!team.leader()) return stay;
  view.write(v, kept.position);
  if (!may_be_written) view.control->count_not_finite();
  if (kept.cut) view.control->count_cut();
  return kept.position;
}

/// Updates the free vertices of a colour. One team runs for each slot.
template <class Gather>
struct UpdateVertex {
  static constexpr int parts = Gather::parts;  ///< number of parts of the vertex's sum
  SweepView view;
  int first_slot = 0;  ///< first slot of the colour
  /// true: the preceding launch may still change the turn, so the turn is checked only after the sum
  bool asks_late;

  template <class Team>
  OGC_HD void operator()(int i, const Team& team) const {
    const SweepVertex vertex = view.vertices[first_slot + i];
    if (!asks_late && view.is_off(vertex)) return team.leave();
    const Vec own = view.old[vertex.vertex];
    if constexpr (Team::moves_totals) {
      ForceAndBlock total = Gather{}(view, first_slot + i, vertex, own, team);
      int slot = first_slot + i;
      const auto thread = team.move_total(total, slot);
      if (!thread.holds_total() || (asks_late && view.is_off())) return;
      const SweepVertex taken = view.vertices[slot];
      const int v = taken.vertex;
      finish(slot, taken, {view.old[v], view.target[v], view.regions.ball(v)}, total, thread);
    } else {
      const State state{own, view.target[vertex.vertex], view.regions.ball(vertex.vertex)};
      ForceAndBlock total = Gather{}(view, first_slot + i, vertex, own, team);
      if (!team.holds_total() || (asks_late && view.is_off())) return;
      finish(first_slot + i, vertex, state, total, team);
    }
  }

  /// Returns whether the team lanes of a vertex share the work after the sum: they do if regions have half-spaces.
  OGC_HD bool shares_end() const { return view.regions.has_planes(); }

 private:
  /// What an update reads of its vertex before the solve: x before the iteration and y [m], and the ball of its region.
  struct State {
    Vec own, target;
    Ball ball;
  };

  /// Solves for the change of the vertex of a slot, truncates it and writes the new position.
  template <class Team>
  OGC_HD void finish(int slot, const SweepVertex& vertex, const State& state, ForceAndBlock& total,
                     const Team& team) const {
    add_inertia(vertex.inertia, state.own, state.target, total);
    const Vec change = solve_symmetric(total.block, total.force, 1.0f / vertex.inertia);
    const Vec x = write_held(view, vertex.vertex, state.own + change, state.own,
                             view.regions.region(vertex.vertex, state.ball),
                             BlockMetric{total.block, 1.0f / vertex.inertia}, team);
    if constexpr (Gather::has_volumes) {
      if (team.leader() && lies_deep_in_volume(view, slot, x)) view.control->count_deep_inside();
    }
  }
};

/// Moves the prescribed vertices before the first colour of an iteration. Runs once for each of these vertices.
struct UpdatePrescribed {
  SweepView view;
  const int* prescribed = nullptr;  ///< indices of the prescribed vertices
  /// cuts are counted for these vertices; each part of a simulation moves all vertices and counts its own
  int first_own = 0, end_own = std::numeric_limits<int>::max();

  OGC_HD void operator()(int i) const {
    if (view.is_off()) return;
    const int v = prescribed[i];
    const Vec target = view.target[v], old = view.old[v];
    if (!is_finite(target)) {
      view.write(v, old);
      view.control->count_not_finite();
      return;
    }
    const FeasibleRegion region = view.regions[v];
    const Truncated kept = held_on_path(region, old, target);
    view.write(v, kept.position);
    if (first_own <= v && v < end_own) count_behind(*view.control, kept, region.ball.centre, view.regions);
  }
};

/// Measures the force on each free vertex at the current positions. One team runs for each slot. In `view` the old and
/// the fresh positions are one buffer (to_fresh = 0), which is not written. Nothing is measured if the view is off.
template <class Gather>
struct MeasureVertex {
  static constexpr int parts = Gather::parts;  ///< number of parts of the vertex's sum
  SweepView view;
  LeftForce* left;  ///< by slot
  bool is_end;  ///< true: measures the force at the end of the step; false: measures the reference after the guess loop

  template <class Team>
  OGC_HD void operator()(int slot, const Team& team) const {
    const SweepVertex vertex = view.vertices[slot];
    if (view.is_off(vertex)) return team.leave();
    const Vec own = view.old[vertex.vertex], target = view.target[vertex.vertex];
    ForceAndBlock total = Gather{}(view, slot, vertex, own, team);
    if (!team.holds_total()) return;
    add_inertia(vertex.inertia, own, target, total);
    const float force = sqrtf(dot(total.force, total.force));
    if (!is_end) {
      if (team.leader()) left[slot].reference = force;
      return;
    }
    const Vec change = solve_symmetric(total.block, total.force, 1.0f / vertex.inertia);
    const bool is_free = is_within(view.regions[vertex.vertex], own + change, team);
    if (!team.leader()) return;
    left[slot].left = force;
    left[slot].rounding = rounding_of_force(total.block, own);
    left[slot].is_held = is_free ? 0 : 1;
  }

 private:
  /// Returns a bound of the error that rounded positions cause in the force. A stored coordinate errs by at most 2⁻²⁴
  /// |x|, so the force errs by at most the block times this error. The blocks between the vertex and its neighbours add
  /// up to about the vertex's own block, which doubles the error.
  OGC_HD static float rounding_of_force(const Symmetric3& block, const Vec& x) {
    const float largest = fmaxf(fmaxf(fabsf(x.x), fabsf(x.y)), fabsf(x.z));
    return 2 * 0x1p-24f * largest * (block.xx + block.yy + block.zz);
  }
};

}  // namespace ogc::fast
