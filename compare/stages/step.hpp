// Stage step: Algorithm 3 with the guess loop of method.md §5.2. Every part of a step is a stage with a contract of its
// own; what is left is the order in which they follow one another, so the answer is a trace, and the judge asks about
// each event what its stage asks.
#pragma once

#include <vector>

#include "compare/stages/sweep.hpp"

namespace ogc::compare {

/// What a step does next.
enum class StepEventKind : std::uint8_t {
  detection,  ///< X_prev ← x; contact sets, bounds
  guess,      ///< a round of the guess loop
  sweep,      ///< one iteration
};

/// One event of a step, and what it left.
struct StepEvent {
  StepEventKind kind = StepEventKind::detection;  ///< what was done
  std::vector<Vec3f> position;  ///< x after the event [m]; of a detection X_prev as later events read it
  Index cut = 0;                ///< guess, sweep: how many vertices it cut, prescribed ones included
  // detection alone
  DetectVertexFacetOut vertex_facet;  ///< of a detection
  DetectEdgeEdgeOut edge_edge;        ///< of a detection
  std::vector<float> bound;           ///< b_v [m]
  VertexPlanes planes{};              ///< where bounds are planes; smallest distances are then not asked for
  /// The stage volume_depth, asked by volume_askers (compare/problem/volumes.hpp) at X_prev of all volumes: `point` is
  /// the vertex, `triangle` and `face` are numbers of the scene; `unresolved` are vertices.
  VolumeDepthOut volumes{};
  std::vector<Quaternion> orientation{};  ///< of a sweep: q of the segments of rods after it
};

/// A step from X⁰, V⁰ of a rounded scene to its first targets of prescribed vertices.
struct StepIn {
  const Scene* scene = nullptr;        ///< rounded; the step begins at its start
  const Topology* topology = nullptr;  ///< of its mesh
};

/// The answer: the step as the contestant made it, event by event.
struct StepOut {
  std::vector<Index> colour;              ///< of the sweeps
  RestStateOut rest;                      ///< of the sweeps
  float query_radius = 0;                 ///< r_q [m]
  std::vector<Vec3f> target;              ///< y [m]
  std::vector<StepEvent> events;          ///< in order
  std::vector<Vec3f> position, velocity;  ///< xᵗ⁺¹ [m], vᵗ⁺¹ = (xᵗ⁺¹ − xᵗ)/h [m/s]
  std::vector<Index> segment_colour{};    ///< of the sweeps
  /// By segment: at the start, turned after the guess loop, at the end
  std::vector<Quaternion> orientation_start{}, turned{}, orientation{};
};

/// What contacts leave of one vertex's move in a round of the guess loop (method.md §5.2).
struct HeldMove {
  Vec3 move;                 ///< m, what is left of y − X_prev [m]
  double accepted = 0;       ///< how far a right answer's m may be from it [m]
  std::uint8_t touches = 0;  ///< 1: of a contact, free or prescribed (which stays after round 1); 0: goes to y
  std::uint8_t grey = 0;     ///< 1: a decision of a contact may go either way, and `accepted` holds both
};

/// What follows from the answer's own positions and counts.
struct StepTruth {
  /// min(r + max ‖y − xᵗ‖, cap), in double; the scale is the radius itself [m]
  double query_radius = 0, query_radius_scale = 0;
  std::vector<Vec3f> prescribed_target;  ///< by vertex; only where prescribed, 0 elsewhere
  /// as Algorithm 3 orders them, given each event's count of cut vertices (0 of those that the answer lacks)
  std::vector<StepEventKind> events;
  /// By event, then by vertex; empty of events that are no rounds.
  /// What contacts took in the rounds before is carried on, with its error, as it is right, since an answer shows
  /// truncated positions alone.
  std::vector<std::vector<HeldMove>> moves{};
  std::vector<Vec3> velocity;          ///< [m/s]
  std::vector<double> velocity_scale;  ///< ‖xᵗ⁺¹ − xᵗ‖/h [m/s]
};

/// In units of u r_q: the rounded difference y − xᵗ (1), products and sums of its square (3, both halved by the root),
/// the root (1), the addition of r (1); or the one rounding of cap · r. Together 4; one more for second order and for
/// the vertex whose length is largest after rounding only.
inline constexpr double step_query_radius_tolerance = 5;
/// In units of u ‖xᵗ⁺¹ − xᵗ‖/h: difference (1), quotient (1), a quarter for second order.
inline constexpr double step_velocity_tolerance = 2.25;

}  // namespace ogc::compare
