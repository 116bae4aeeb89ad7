// Begins a step, and runs the rounds of the guess loop (Eq. 28; method.md §5.2).
#pragma once

#include <cmath>
#include <cstdint>

#include "fast/kernels/certificate.hpp"
#include "fast/kernels/control.hpp"
#include "fast/kernels/held.hpp"
#include "fast/kernels/inertia.hpp"
#include "fast/kernels/plane_lists.hpp"
#include "fast/kernels/touching_move.hpp"

namespace ogc::fast {

/// Sets x = xᵗ and y for each vertex, and finds the largest move. For a prescribed vertex y is the target of this step,
/// for a fixed vertex its position. Runs once for each vertex.
struct BeginVertex {
  const Vec* start;               ///< xᵗ
  const Vec* velocity;            ///< vᵗ
  const int* prescribed_number;   ///< by vertex: index among the prescribed vertices; −1: free, −2: fixed
  const Vec* prescribed_targets;  ///< [step since the last stored state][number of the prescribed vertex]
  int prescribed_count;           ///< prescribed vertices: length of a row of targets
  Vec acceleration;               ///< a [m/s²]
  float step;                     ///< h [s]
  Vec* position;                  ///< x by vertex [m], written
  Vec* target;                    ///< y by vertex [m], written
  Vec* taken;                     ///< by vertex; set to 0, as the first round of the guess loop expects
  StepControl* control;  ///< on the backend; largest_move is raised, moves that are infinite or NaN are counted
  /// by vertex: not 0 on driven volumes, which move to their targets here; null if there are no driven volumes
  const std::uint8_t* is_driven_volume = nullptr;

  OGC_HD void operator()(int v) const {
    const Vec x = start[v];
    const int number = prescribed_number[v];
    Vec y = x;
    if (number == -1) y = inertia_target(x, velocity[v], acceleration, step);
    if (number >= 0) y = prescribed_targets[control->steps_done * prescribed_count + number];
    position[v] = is_driven_volume != nullptr && is_driven_volume[v] != 0 ? y : x;
    target[v] = y;
    taken[v] = {};
    const Vec move = y - x;
    const float length = square_root(dot(move, move));
    if (!is_finite(length)) {
      control->count_not_finite();
      return;
    }
    raise_together(&control->largest_move, float_bits(length));
  }
};

/// Checks before a detection, in double on stored positions, that each vertex is in its old region; then sets X_prev ←
/// x. Before the first detection of a step it checks nothing, because the end of the previous step checked the old
/// regions. Runs once for each vertex.
struct BeginRegions {
  const Vec* position;    ///< x by vertex [m]
  FeasibleRegions ended;  ///< regions of the last detection
  Vec* previous;          ///< X_prev by vertex [m], written
  StepControl* control;   ///< on the backend; vertices outside their region are counted
  /// w by vertex [m], written: y − x if `target` is set, else x − X_prev; null unless planes divide gaps by speed
  /// (bounds=dat)
  Vec* displacement = nullptr;
  const Vec* target = nullptr;  ///< y by vertex in the guess loop, later null; read only if `displacement` is set

  OGC_HD void operator()(int v) const {
    const Vec x = position[v];
    if (control->rounds > 0 && is_outside(ended[v], x)) control->count_violation();
    if (displacement != nullptr) displacement[v] = target != nullptr ? target[v] - x : x - previous[v];
    previous[v] = x;
  }
};

/// Sets x to y, truncated to the region. Before this, contacts may shorten the move of a free vertex. The truncation
/// slides a free vertex along half-spaces with the metric of inertia. From the second round on, a prescribed vertex in
/// contact stays, because only the sweeps move its neighbours out of its way. Runs once for each vertex from `first`
/// on; lanes may share the half-spaces of a vertex.
struct GuessVertex {
  const Vec* target;        ///< y by vertex [m]
  FeasibleRegions regions;  ///< about X_prev
  /// reads the first half of the double buffer `taken` in even rounds, the second half in odd rounds; the kernel writes
  /// the other half
  GuessContacts contacts;
  int vertex_count;              ///< length of one half of `taken`
  Vec* taken;                    ///< both halves: by how much contacts change each vertex's move [m], written
  Vec* position;                 ///< x by vertex [m], written
  StepControl* control;          ///< on the backend; `active` and `rounds` are read, cuts are counted
  const int* prescribed_number;  ///< as in BeginVertex
  int first = 0;                 ///< number of the first vertex

  OGC_HD void operator()(int i) const { (*this)(i, SerialTeam<1>{}); }
  template <class Lanes>
  OGC_HD void operator()(int i, const Lanes& lanes) const {
    if (control->active == 0) return;
    const int v = first + i;
    const FeasibleRegion region = regions[v];
    const Vec& stay = region.ball.centre;
    Vec change;
    const Vec wanted = proposal(v, stay, change);
    const bool is_prescribed = regions.has_planes() && prescribed_number[v] >= 0;
    const Truncated kept = is_prescribed ? held_on_path(region, stay, wanted)
                                         : held(region, stay, wanted, InertiaMetric{}, lanes);
    if (!lanes.leader()) return;
    taken[control->rounds % 2 != 0 ? v : v + vertex_count] = change;
    position[v] = kept.position;
    if (is_prescribed)
      count_behind(*control, kept, stay, regions);
    else if (kept.cut)
      control->count_cut();
  }

 private:
  /// Returns the position before truncation: exactly y if no contact shortens the move. From the second round on, a
  /// prescribed vertex in contact stays at `stay`. `change`: by how much contacts change the move [m]; written only if
  /// they do.
  OGC_HD Vec proposal(int v, const Vec& stay, Vec& change) const {
    GuessContacts here = contacts;
    if (control->rounds % 2 != 0) here.taken += vertex_count;
    if (here.offsets == nullptr || prescribed_number[v] == -2) return target[v];
    if (prescribed_number[v] >= 0) return control->rounds > 0 && touches(here, v) ? stay : target[v];
    const Vec move = target[v] - stay, held = held_move(here, v, move);
    if (held.x == move.x && held.y == move.y && held.z == move.z) return target[v];
    change = held - move;
    return stay + held;
  }
};

/// Copies xᵗ and x after the guess loop into the buffers of the sweep. Both position buffers get x, because the sweep
/// never writes fixed vertices. Runs once for each vertex.
struct BeginSweep {
  const Vec* start;         ///< xᵗ by vertex [m]
  const Vec* position;      ///< x by vertex [m]
  PaddedVec* padded_start;  ///< xᵗ by vertex [m], written
  PaddedVec* padded;        ///< x by vertex, in the old buffer and in the fresh buffer behind it, written [m]
  int vertex_count;         ///< length of one buffer

  OGC_HD void operator()(int v) const {
    const PaddedVec x(position[v]);
    padded_start[v] = PaddedVec(start[v]);
    padded[v] = x;
    padded[v + vertex_count] = x;
  }
};

}  // namespace ogc::fast
