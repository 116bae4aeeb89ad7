// Ends a step: checks the last certificate, commits positions and velocities, and sums the terms of the row that
// reports the step. Terms are in double; no position depends on them.
#pragma once

#include <cmath>

#include "fast/contact_view.hpp"
#include "fast/kernels/certificate.hpp"
#include "fast/kernels/contact_force.hpp"
#include "fast/kernels/control.hpp"
#include "fast/kernels/lists.hpp"
#include "fast/kernels/sum_columns.hpp"

namespace ogc::fast {

/// A row of the device's report, one for each step of a frame. The host converts it to a compare::StepMetrics.
struct StepRow {
  int status = 0;                                         ///< compare::StepStatus bits; 0: the step was committed
  int vertex_facet_contacts = 0, edge_edge_contacts = 0;  ///< records of the last detection
  /// counts of the step; cut_last: vertices that the last iteration cut
  int detections = 0, rounds = 0, iterations = 0, cut_last = 0;
  /// r_q, largest lag, and smallest b_v (with planes: smallest distance of any pair) [m]
  float query_radius = 0, largest_lag = 0, smallest_bound = 0;
  double lost_guess = 0, lost_end = 0;  ///< ‖Σ m (x − y)‖/‖Σ m (y − xᵗ)‖ after the guess loop and at the end [1]
  /// at the end [J]; without StepSettings::energies, `elastic` is only the energy of tetrahedra, and `contact` is 0
  double kinetic = 0, gravity = 0, elastic = 0, contact = 0;
  int inverted = 0;  ///< tetrahedra with J ≤ 0
  /// at the last detection: contacts with volumes, vertices inside, sheets without a path to the boundary, largest
  /// depth [m]
  int volume_contacts = 0, vertices_inside = 0, depth_unresolved = 0;
  float deepest = 0;
  /// with rods: smallest distance of contacts that exert a force [m], largest and mean ‖D‖/l − 1 of segments
  float smallest_contact = 0, largest_stretch = 0;
  double mean_stretch = 0;
  double last_motion = 0;  ///< motion of the last sweep divided by the motion of the step, weighted by mass [1]
  /// if forces were measured: residual of Eq. 29, the part of it that rounding may cause [1], and the number of
  /// vertices that a bound holds
  double left_residual = 0, left_rounding = 0;
  int left_held = 0;
};

/// Checks the certificate of a vertex at the end of a step, and updates the largest lag and the smallest bound (with
/// planes: the smallest distance of a pair). Runs once for each vertex.
struct CheckVertex {
  const Vec* position;             ///< x by vertex [m]
  FeasibleRegions regions;         ///< of the last detection
  const Vec* target;               ///< y by vertex [m]
  const int* prescribed_number;    ///< by vertex: index among the prescribed vertices; −1: free, −2: fixed
  StepControl* control;            ///< on the backend; counts and extremes are written
  const float* nearest = nullptr;  ///< by vertex: smallest distance [m]; set if there are planes

  OGC_HD void operator()(int v) const {
    if (control->active == 0) return;
    const Vec x = position[v];
    if (!is_finite(x)) control->count_not_finite();
    if (is_outside(regions[v], x)) control->count_violation();
    lower_together(&control->smallest_bound, regions.has_planes() ? nearest[v] : regions.radius[v]);
    if (prescribed_number[v] < 0) return;
    const Vec behind = target[v] - x;
    atomic_max(&control->largest_lag, float_bits(square_root(dot(behind, behind))));
  }
};

/// Stops the step before its commit if a check failed.
struct EndCheck {
  StepControl* control;  ///< on the backend

  OGC_HD void operator()(int) const { stop_if_failed(*control); }
};

/// Commits a vertex of a step that did not fail: v = (x − xᵗ)/h, xᵗ = x. Runs once for each vertex.
struct CommitVertex {
  const Vec* position;         ///< x by vertex [m]
  float step;                  ///< h [s]
  const StepControl* control;  ///< on the backend; if not active the step failed, and nothing is written
  Vec* start;                  ///< xᵗ by vertex [m]; becomes x
  Vec* velocity;               ///< by vertex [m/s], written

  OGC_HD void operator()(int v) const {
    if (control->active == 0) return;
    const Vec x = position[v], moved = x - start[v];
    velocity[v] = {moved.x / step, moved.y / step, moved.z / step};
    start[v] = x;
  }
};

/// Copies the bounds into a stored state. Runs once for each vertex.
struct CopyBound {
  const float* from;  ///< b_v by vertex [m]
  float* to;

  OGC_HD void operator()(int v) const { to[v] = from[v]; }
};

/// Holds the positions before the last sweep of a step. Sweeps read two buffers in turn, the first one first.
struct BeforeLastSweep {
  const PaddedVec* buffers = nullptr;  ///< x by vertex, two buffers one after the other [m]; null: no sweep was made
  int vertex_count = 0;
  const int* sweeps = nullptr;  ///< number of the step's sweeps, on the backend

  OGC_HD Vec operator()(int v) const { return PaddedVecs{buffers}[*sweeps % 2 == 0 ? v + vertex_count : v]; }
};

/// Adds the terms of a vertex to the sums, before the commit: kinetic energy, gravity, lost momentum and last motion.
/// After the guess loop, only the lost momentum is reported.
struct VertexTerm {
  const Vec* position;           ///< x by vertex [m]
  BeforeLastSweep before;        ///< x by vertex before the last sweep [m]
  const Vec* start;              ///< xᵗ by vertex [m]
  const Vec* target;             ///< y by vertex [m]
  const float* mass;             ///< by vertex [kg]; 0 on fixed bodies
  const int* prescribed_number;  ///< as in CheckVertex; only free vertices add to the momenta
  Vec acceleration;              ///< a [m/s²]
  double step;                   ///< h [s]

  OGC_HD void operator()(int v, double* sum) const {
    const double m = mass[v];
    const Vec x = position[v], s = start[v], y = target[v];
    const double moved[3] = {static_cast<double>(x.x) - s.x, static_cast<double>(x.y) - s.y,
                             static_cast<double>(x.z) - s.z};
    sum[sum_kinetic] += 0.5 * m * (moved[0] * moved[0] + moved[1] * moved[1] + moved[2] * moved[2]) / (step * step);
    sum[sum_gravity] -= m * (static_cast<double>(acceleration.x) * x.x + static_cast<double>(acceleration.y) * x.y +
                             static_cast<double>(acceleration.z) * x.z);
    if (prescribed_number[v] != -1) return;
    sum[sum_lost] += m * (static_cast<double>(x.x) - y.x);
    sum[sum_lost + 1] += m * (static_cast<double>(x.y) - y.y);
    sum[sum_lost + 2] += m * (static_cast<double>(x.z) - y.z);
    sum[sum_moved] += m * (static_cast<double>(y.x) - s.x);
    sum[sum_moved + 1] += m * (static_cast<double>(y.y) - s.y);
    sum[sum_moved + 2] += m * (static_cast<double>(y.z) - s.z);
    if (before.buffers == nullptr) return;
    const Vec b = before(v);
    const double last[3] = {static_cast<double>(x.x) - b.x, static_cast<double>(x.y) - b.y,
                            static_cast<double>(x.z) - b.z};
    sum[sum_last] += m * (last[0] * last[0] + last[1] * last[1] + last[2] * last[2]);
    sum[sum_way] += m * (moved[0] * moved[0] + moved[1] * moved[1] + moved[2] * moved[2]);
  }
};

/// Returns ‖Σ m (x − y)‖ / ‖Σ m (y − xᵗ)‖; 0 if the denominator is 0.
OGC_HD inline double momentum_lost(const double* sums) {
  const double lost = sums[sum_lost] * sums[sum_lost] + sums[sum_lost + 1] * sums[sum_lost + 1] +
                      sums[sum_lost + 2] * sums[sum_lost + 2];
  const double moved = sums[sum_moved] * sums[sum_moved] + sums[sum_moved + 1] * sums[sum_moved + 1] +
                       sums[sum_moved + 2] * sums[sum_moved + 2];
  return moved > 0 ? sqrt(lost / moved) : 0.0;
}

/// Returns the quotient of two sums; 0 if `whole` is 0.
OGC_HD inline double share_of(double part, double whole) { return whole > 0 ? part / whole : 0.0; }

/// Writes the row of a step, as the last kernel of the step. A failed step has a row, too. Only a step that stopped
/// because a list was full has none, because it is repeated.
struct FinishStep {
  StepControl* control;  ///< on the backend
  ContactView contacts;  ///< their counts are reported
  /// by SumColumn: first the `guess_columns` sums after the guess loop, then the sums at the end of the step
  const double* sums;
  StepRow* rows;     ///< by step since the last stored state, on the backend
  int segments = 0;  ///< segments of rods
  /// sums by LeftColumn, on the backend; null if forces were not measured
  const double* left = nullptr;
  int free_vertices = 0;
  ListRoom room{};  ///< if a list is nearly full, the frame ends with this step, so that the host can make room

  OGC_HD void operator()(int) const {
    StepControl& c = *control;
    if (c.attempted == 0 || (c.status & compare::step_list_grew) != 0) return;
    const double *sums_guess = sums, *sums_end = sums + guess_columns;
    StepRow row;
    row.status = c.status;
    row.vertex_facet_contacts = *contacts.vertex_facet_count;
    row.edge_edge_contacts = *contacts.edge_edge_count;
    row.detections = c.detections;
    row.rounds = c.rounds;
    row.iterations = c.iterations;
    row.cut_last = c.cut_last;
    row.query_radius = c.query_radius;
    row.largest_lag = float_from_bits(c.largest_lag);
    row.smallest_bound = c.smallest_bound;
    row.lost_guess = momentum_lost(sums_guess);
    row.lost_end = momentum_lost(sums_end);
    row.kinetic = sums_end[sum_kinetic];
    row.gravity = sums_end[sum_gravity];
    row.elastic = sums_end[sum_membrane] + sums_end[sum_bending] + sums_end[sum_solid];
    row.inverted = static_cast<int>(sums_end[sum_inverted]);
    row.contact = sums_end[sum_vertex_facet] + sums_end[sum_edge_edge];
    row.volume_contacts = c.volume_contacts;
    row.vertices_inside = c.vertices_inside;
    row.depth_unresolved = c.depth_unresolved;
    row.deepest = float_from_bits(c.deepest);
    if (segments > 0) {
      row.elastic += sums_end[sum_rod];
      row.mean_stretch = sums_end[sum_stretch] / segments;
      row.largest_stretch = float_from_bits(c.longest_segment) - 1.0f;
      row.smallest_contact = c.nearest_contact;
    }
    row.last_motion = sqrt(share_of(sums_end[sum_last], sums_end[sum_way]));
    if (left != nullptr) add_left(row);
    rows[c.steps_done] = row;
    if (c.active == 0) return;
    ++c.steps_done;
    if (room.is_short()) c.short_of_room = 1, c.active = 0;
  }

 private:
  /// Writes the residual of Eq. 29: the mean of ‖f‖ over the vertices that no bound holds, divided by the mean of ‖f*‖
  /// over all free vertices.
  OGC_HD void add_left(StepRow& row) const {
    const double reference = share_of(left[left_reference], free_vertices), unheld = free_vertices - left[left_held];
    row.left_residual = share_of(share_of(left[left_force], unheld), reference);
    row.left_rounding = share_of(share_of(left[left_rounding], unheld), reference);
    row.left_held = static_cast<int>(left[left_held]);
  }
};

}  // namespace ogc::fast
