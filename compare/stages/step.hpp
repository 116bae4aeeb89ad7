// Stage step: Algorithm 3 with the guess loop of method.md §5.2. Every part of a step is a stage with its own contract,
// so only their order is left to check. The answer is a trace of events: detections, guess rounds and sweeps. The judge
// checks each event as an answer of its stage.
#pragma once

#include <vector>

#include "compare/stages/sweep.hpp"

namespace ogc::compare {

/// Kinds of events of a step.
enum class StepEventKind : std::uint8_t {
  detection,  ///< X_prev ← x; contact sets, bounds
  guess,      ///< a round of the guess loop
  sweep,      ///< one iteration
};

/// One event of a step, and its results.
struct StepEvent {
  StepEventKind kind = StepEventKind::detection;  ///< kind of the event
  std::vector<Vec3f> position;  ///< x after the event [m]; for a detection its X_prev, which later events read
  Index cut = 0;                ///< number of vertices that a guess round or sweep cut, prescribed ones included
  /// Contacts that a detection found; empty for other events.
  DetectVertexFacetOut vertex_facet;
  DetectEdgeEdgeOut edge_edge;
  std::vector<float> bound;  ///< b_v [m]; only for a detection
  VertexPlanes planes{};     ///< only for a detection, if bounds are planes; smallest distances are not needed then
  /// Contacts of all volumes with volume_askers (compare/problem/volumes.hpp) at X_prev, as stage volume_depth returns
  /// them. `point` is the vertex, `triangle` and `face` are numbers of the scene; `unresolved` are vertices.
  VolumeDepthOut volumes{};
  std::vector<Quaternion> orientation{};  ///< after a sweep: q of the rods' segments
};

/// Input of the stage: a step from X⁰, V⁰ of a rounded scene to the first targets of its prescribed vertices.
struct StepIn {
  const Scene* scene = nullptr;        ///< rounded; its start is the start of the step
  const Topology* topology = nullptr;  ///< of the scene's mesh
};

/// The answer: the contestant's step, event by event.
struct StepOut {
  std::vector<Index> colour;              ///< colour of each vertex in the sweeps
  RestStateOut rest;                      ///< rest state of the sweeps
  float query_radius = 0;                 ///< r_q [m]
  std::vector<Vec3f> target;              ///< y [m]
  std::vector<StepEvent> events;          ///< in order
  std::vector<Vec3f> position, velocity;  ///< xᵗ⁺¹ [m], vᵗ⁺¹ = (xᵗ⁺¹ − xᵗ)/h [m/s]
  std::vector<Index> segment_colour{};    ///< colour of each segment in the sweeps
  /// by segment: orientation at the start of the step, after the rotation that follows the guess loop, and at the end
  /// of the step
  std::vector<Quaternion> orientation_start{}, turned{}, orientation{};
};

/// The part of a vertex's move that contacts leave in a round of the guess loop (method.md §5.2).
struct HeldMove {
  Vec3 move;            ///< m, the part of y − X_prev that contacts leave [m]
  double accepted = 0;  ///< largest error of m in a right answer [m]
  /// 1: a free vertex with a contact, or a prescribed vertex that stays where it is because of a contact (after round
  /// 1); 0: the vertex goes to y
  std::uint8_t touches = 0;
  std::uint8_t grey = 0;  ///< 1: a decision of a contact may go either way; `accepted` covers both outcomes
};

/// Results that follow from the answer's own positions and counts.
struct StepTruth {
  /// min(r + max ‖y − xᵗ‖, cap), in double; the scale of its error is the radius itself [m]
  double query_radius = 0, query_radius_scale = 0;
  std::vector<Vec3f> prescribed_target;  ///< by vertex; 0 for vertices that are not prescribed
  /// kinds of the events that Algorithm 3 requires, in order. They depend on the answer's counts of cut vertices (0 for
  /// events that the answer lacks) and, with `settled_move`, on how far its iterations moved vertices
  std::vector<StepEventKind> events;
  /// by event, then by vertex; empty for events other than guess rounds. An answer does not show how much of a move
  /// contacts removed in earlier rounds. The truth computes this amount; `accepted` includes its error
  std::vector<std::vector<HeldMove>> moves{};
  std::vector<Vec3> velocity;          ///< [m/s]
  std::vector<double> velocity_scale;  ///< ‖xᵗ⁺¹ − xᵗ‖/h [m/s]
};

/// Largest error of r_q in units of u r_q, u = 2⁻²⁴. r_q is r + max ‖y − xᵗ‖ or cap · r. Rounding errors:
///
/// - r + max ‖y − xᵗ‖, 4.5: the difference y − xᵗ (1); a product and two sums of its square (3, halved by the root);
///   the root (1); the addition of r (1). The largest of rounded lengths errs by no more than a length does.
/// - cap · r: 1
///
/// A half more covers second order.
inline constexpr double step_query_radius_tolerance = 5;
/// Largest error of a velocity in units of u ‖xᵗ⁺¹ − xᵗ‖/h: difference (1), quotient (1), a quarter for second order.
inline constexpr double step_velocity_tolerance = 2.25;

}  // namespace ogc::compare
