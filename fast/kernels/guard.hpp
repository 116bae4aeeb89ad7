// Moves the vertices of a guard (fast/guard.hpp) as far as their regions allow, and says what that took from the
// caller's motion.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fast/kernels/arithmetic/atomic.hpp"
#include "fast/kernels/control.hpp"
#include "fast/kernels/held.hpp"

namespace ogc::fast {

/// The sums of a step of a guard over all vertices: vertices that were cut, vertices whose proposal was not finite,
/// ‖p − s‖, ‖p − x‖ and the normal and the tangential part of p − x [m].
enum GuardColumn {
  guard_cut,
  guard_not_finite,
  guard_asked,
  guard_lost,
  guard_normal,
  guard_tangential,
  guard_columns
};

/// What a step of a guard reports, on the backend.
struct GuardRow {
  double sums[guard_columns] = {};  ///< by GuardColumn
  /// The most restricted vertex: bits 32 … 62 have the bits of ‖p − x‖ as a float, rounded, bits 0 … 31 have the
  /// complement of the vertex. So the largest number is the largest loss, and the lowest vertex among equal losses.
  /// 0: nothing was lost.
  std::uint64_t most_restricted = 0;
};

/// The terms of one vertex in the sums, by GuardColumn.
struct GuardTerm {
  double of[guard_columns];
};

/// Adds the caller's positions and moves, each rounded to single precision. Runs once for each vertex.
struct Propose {
  const Vec *position, *move;  ///< by vertex [m]
  Vec* proposal;               ///< by vertex [m], written
  GuardRow* row;               ///< its most restricted vertex is reset

  OGC_HD void operator()(int v) const {
    proposal[v] = position[v] + move[v];
    if (v == 0) row->most_restricted = 0;
  }
};

/// Returns a direction from the region's inside through its boundary, where the boundary cut `proposal`: the normal of
/// the half-space that `proposal` violates most, the first of equals; if it violates none, the direction from X_prev to
/// `proposal`, because the ball cut it. Its length is 1 up to rounding; it is 0 if the length of that direction
/// underflows.
OGC_HD inline slide::Point cutting_normal(const FeasibleRegion& region, const Vec& proposal) {
  int most = -1;
  double deepest = 0;
  for (int k = 0; k < region.count; ++k) {
    const double depth = excess(region.planes[k].normal, region.planes[k].offset, proposal).value;
    if (depth > deepest) deepest = depth, most = k;
  }
  const slide::Point n = most < 0 ? slide::wide(proposal) - slide::wide(region.ball.centre)
                                  : slide::wide(region.planes[most].normal);
  const double length = square_root(dot(n, n));
  return length > 0 ? divide(1, length) * n : slide::Point{};
}

/// Truncates each proposal into the vertex's region. A free vertex slides on the shortest way. A vertex with a proposal
/// that is not finite stays where it is, and counts as cut. Runs once for each vertex; lanes may share the half-spaces
/// of a vertex.
struct KeepInside {
  const Vec *proposal, *current;  ///< by vertex [m]; `current`: the guard's state, in the regions
  FeasibleRegions regions;        ///< about X_prev
  Vec *next, *out;                ///< by vertex [m], written: the guard's new state, and the caller's copy of it
  GuardTerm* terms;               ///< by vertex, written
  GuardRow* row;                  ///< its most restricted vertex is raised

  OGC_HD void operator()(int v) const { (*this)(v, SerialTeam<1>{}); }
  template <class Lanes>
  OGC_HD void operator()(int v, const Lanes& lanes) const {
    const FeasibleRegion region = regions[v];
    const Vec wanted = proposal[v], from = current[v];
    const bool finite = is_finite(wanted);
    const Truncated kept = finite ? held(region, from, wanted, InertiaMetric{}, lanes) : Truncated{from, true};
    if (!lanes.leader()) return;
    next[v] = out[v] = kept.position;
    GuardTerm term{};
    term.of[guard_cut] = kept.cut ? 1 : 0;
    term.of[guard_not_finite] = finite ? 0 : 1;
    if (finite) term.of[guard_asked] = length_of(slide::wide(wanted) - slide::wide(from));
    if (finite && kept.cut) add_loss(v, region, wanted, kept.position, term);
    terms[v] = term;
  }

 private:
  static OGC_HD double length_of(const slide::Point& a) { return square_root(dot(a, a)); }
  OGC_HD void add_loss(int v, const FeasibleRegion& region, const Vec& wanted, const Vec& kept, GuardTerm& term) const {
    const slide::Point lost = slide::wide(wanted) - slide::wide(kept), n = cutting_normal(region, wanted);
    const double along = dot(n, lost);
    term.of[guard_lost] = length_of(lost);
    term.of[guard_normal] = modulus(along);
    term.of[guard_tangential] = length_of(lost - along * n);
    const auto bits = static_cast<std::uint64_t>(float_bits(static_cast<float>(term.of[guard_lost])));
    atomic_max(&row->most_restricted, bits << 32 | static_cast<std::uint32_t>(~v));
  }
};

/// Sums the terms of all vertices.
struct GuardSums {
  const GuardTerm* terms;  ///< by vertex
  int count;               ///< vertices

  /// Adds every `chunks`-th term, beginning with term `chunk`.
  OGC_HD void add(int chunk, int chunks, double* sums) const {
    for (int v = chunk; v < count; v += chunks)
      for (int k = 0; k < guard_columns; ++k) sums[k] += terms[v].of[k];
  }
};

}  // namespace ogc::fast
