// Defines what the judge compares: a contestant has a name, a callable for each of its stages, and a resident
// simulation. The judge drives two contestants through the same cases and never learns which is which.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "compare/problem/scene.hpp"
#include "compare/stages/names.hpp"
#include "compare/stages/vertex_planes.hpp"

namespace ogc::compare {

/// Reasons why a step is not clean; bits of StepMetrics::status.
enum StepStatus : std::uint32_t {
  step_clean = 0,
  step_list_grew = 1,       ///< a list was too small: it grew and the step was repeated
  step_not_finite = 2,      ///< a position became NaN or infinite: the run stops and keeps the last good state
  step_bound_violated = 4,  ///< the motion certificate failed: ‖x − x_prev‖ > b_v in double
  /// the solver's iterations ended above its tolerance: the run stops and keeps the last good state
  step_not_converged = 8,
  /// the solver's matrix is not positive definite, or no step lowers the energy: the run stops and keeps the last good
  /// state
  step_indefinite = 16,
  step_met = 32,  ///< faces met during the step, although bounds forbid it (compare/oracle/meetings.hpp)
};

/// One row of iterations.csv, which solvers with iteration rows fill. A row describes the state at the start of its
/// iteration; the last row of a step describes the state at the step's end.
struct IterationMetrics {
  std::int64_t step = 0, iteration = 0;  ///< step from 1; iteration from 0 in each step
  double wall_ms = 0;                    ///< since the step began
  double residual = 0;                   ///< Eq. 29 with the contacts of the last detection
  double energy = 0;                     ///< incremental potential with these contacts [J]
  double largest_change = 0;             ///< ‖δ‖_∞ of the solve, before any truncation [m]
  double share = 0;  ///< share of the (truncated) solution that the line search took; 0 if no step was taken
  std::int64_t vertices_cut = 0;  ///< vertices cut in this iteration
  std::int64_t detected = 0;      ///< 1 if contacts were detected anew for this state
  double condition_number = 0;    ///< condition number of the matrix; not-a-number unless requested
  /// Condition numbers of the matrix without friction terms, and without contact and friction terms. A matrix that is
  /// not positive definite is replaced by the sum of its terms' projections.
  double condition_without_friction = 0, condition_without_contact = 0;
  /// counts of this iteration; StepMetrics defines them
  std::int64_t broad_phases = 0, discrete_detections = 0, continuous_detections = 0;
};

/// Holds what each part of a step does to energy and momentum: columns of steps.csv with `ogc run --ledger`
/// (reference/ledger.md). Except for energy_start all energies [J] are changes. Momenta and motions [kg m/s] are sums
/// over free vertices.
struct StepLedger {
  double energy_start = 0;                        ///< E at xᵗ with vᵗ
  double energy_guess = 0, energy_detection = 0;  ///< changes by guess rounds and by new contacts
  /// changes from x to the proposals, and from the proposals to the new x
  double energy_sweep = 0, energy_truncation = 0;
  double energy_commit = 0;  ///< change from the last x to the start of the next step
  Vec3 momentum_start, momentum_guess, momentum_sweep, momentum_truncation;  ///< Σ m v at the start, and its changes
  double motion_proposed = 0, motion_taken = 0;  ///< motion that sweeps propose, and the part that truncation takes
  /// parts of motion_taken: across the normal n of the nearest pair, and against n where the vertex moved away (n
  /// points to the pair's other side)
  double motion_taken_tangential = 0, motion_taken_leaving = 0;
  double motion_taken_unpaired = 0;  ///< part of motion_taken at vertices without a pair within r_q
  /// number of free vertices whose final position is xᵗ bit for bit; number of these that the last iteration cut
  double vertices_still = 0, vertices_held = 0;
};

/// One row of steps.csv. Times are in ms. A quantity that was not requested is not-a-number.
struct StepMetrics {
  std::int64_t step = 0;  ///< number of the step that this row describes, from 1
  /// time of the step: by a steady clock, or by device events if CUDA replays a recorded step
  double wall_ms = 0;
  std::int64_t vertex_facet_contacts = 0, edge_edge_contacts = 0;  ///< at the last detection
  /// number of passes that built or refitted the trees and searched them once for all pairs
  std::int64_t broad_phases = 0;
  /// number of searches for the contacts or distances of all pairs at one state; checks of a line search for
  /// intersections are not counted
  std::int64_t discrete_detections = 0;
  /// number of searches for the first contact of all pairs, or of the active pairs, along one motion
  std::int64_t continuous_detections = 0;
  std::int64_t guess_rounds = 0, iterations = 0;
  std::int64_t vertices_cut = 0;                          ///< vertices cut in the last iteration
  double share_cut = 0;                                   ///< vertices_cut / K, K free and prescribed vertices
  double momentum_lost_guess = 0, momentum_lost_end = 0;  ///< ‖Σ m (x − y)‖ / ‖Σ m (y − xᵗ)‖ (method.md §5.3)
  double largest_lag = 0;   ///< largest distance of a prescribed vertex behind its target [m]
  double query_radius = 0;  ///< r_q of the step [m]
  double residual = 0;      ///< Eq. 29
  /// √(Σ m ‖Δx‖²) of free vertices in the last sweep or iteration, divided by its value for the whole step; 0 if
  /// nothing moves [1]
  double last_motion = std::numeric_limits<double>::quiet_NaN();
  /// Quantities that only some steps report (method.md §6):
  ///
  /// - left_residual: Eq. 29 with the contacts of the step, over free vertices that no bound holds
  /// - left_rounding: upper limit of the part of left_residual that rounding of positions causes [1]
  /// - left_held: number of free vertices that a bound holds
  double left_residual = std::numeric_limits<double>::quiet_NaN(),
         left_rounding = std::numeric_limits<double>::quiet_NaN(), left_held = std::numeric_limits<double>::quiet_NaN();
  double kinetic_energy = 0, elastic_energy = 0, contact_energy = 0, gravity_energy = 0;  ///< [J]
  double smallest_distance = 0;          ///< smallest d_min at the last detection (r_q if no pair is near) [m]
  std::int64_t inverted_tetrahedra = 0;  ///< tetrahedra with J ≤ 0 at the end of the step
  /// At the last detection:
  ///
  /// - volume_contacts: contacts with volumes
  /// - vertices_inside: tested vertices inside a volume
  /// - deepest: largest distance of these vertices from the surface [m]
  /// - depth_unresolved: sheets of tetrahedra at these vertices from which no way leads to the boundary
  std::int64_t volume_contacts = 0, vertices_inside = 0;
  double deepest = 0;
  std::int64_t depth_unresolved = 0;
  /// pairs of faces that shared a point during the step (compare/meetings.md)
  double meetings = std::numeric_limits<double>::quiet_NaN();
  /// At the end of a step of a scene with rods: smallest distance of active contacts (not-a-number if there are none)
  /// [m], mean and largest strain ‖D‖/l − 1 of the segments [1].
  double smallest_contact_distance = 0, mean_stretch = 0, largest_stretch = 0;
  std::int64_t repeats = 0;  ///< times the step was repeated because a list grew
  std::uint32_t status = step_clean;
  std::optional<StepLedger> ledger{};  ///< filled if requested
  /// problems that the solver met, by name, and how it continued; for the user, not in steps.csv
  std::vector<std::string> notes;
  std::vector<IterationMetrics> iteration_rows;  ///< with SimulationOptions::iterations
  /// with profile: time of each stage, in the order of Simulation::stage_names()
  std::vector<double> stage_ms;
  /// With profile and iterations, if a trace tells the iterations (Contestant::step): measured times from the start of
  /// the step to the end of each detection, and to the start of the first iteration and the end of each [ms].
  std::vector<double> detection_ends_ms, iteration_ends_ms;
};

/// Holds the state at the end of a step and the data that the motion certificate needs.
struct Snapshot {
  std::int64_t step = 0;                     ///< number of the step
  std::vector<Vec3f> positions, velocities;  ///< [m], [m/s]
  std::vector<Vec3f> previous;               ///< X_prev of the last detection
  std::vector<float> bounds;                 ///< b_v of the last detection
  float query_radius = 0;                    ///< r_q of the last detection
  /// capacities of growing lists, in the contestant's order. If a capacity is too small, the step is repeated;
  /// positions do not depend on capacities
  std::vector<std::int64_t> capacities{};
  /// unrounded positions and velocities of a solver with a state in double; otherwise empty
  std::vector<Vec3> exact_positions{}, exact_velocities{};
  VertexPlanes planes{};  ///< planes of the last detection; empty unless bounds are planes
  /// orientations of the segments of rods, in the order of rod_segments (compare/problem/rods.hpp)
  std::vector<Quaternion> orientations{};
  /// by vertex: distance within which the next detection searches for all pairs of the vertex [m]. Only the time of the
  /// next step and its need of larger lists depend on it. Empty: unknown, or bounds are not planes
  std::vector<float> search_limits{};
};

/// Selects what a simulation records besides its states.
struct SimulationOptions {
  bool profile = false;  ///< times by stage (adds synchronisations)
  bool energies = true;  ///< energies of StepMetrics
  /// StepMetrics::iteration_rows if the solver keeps them; else, with profile, the ends of events (adds
  /// synchronisations)
  bool iterations = false;
  bool condition = false;  ///< condition number in each iteration row (slow), if the solver factorises
};

/// A simulation whose data stay where the contestant computes; they are copied to the host only on request.
class Simulation {
 public:
  virtual ~Simulation() = default;
  /// Runs `steps` steps (a frame) and returns one row for each. Stops early after a row whose status ends the run, for
  /// example step_not_finite or step_bound_violated.
  virtual std::vector<StepMetrics> advance(std::int64_t steps) = 0;
  virtual Snapshot snapshot() = 0;
  /// Continues from the positions, velocities, orientations and step number of a snapshot. Reserves lists of
  /// `capacities` unless it is empty. Recomputes everything else.
  virtual void restore(const Snapshot& snapshot) = 0;
  virtual std::vector<std::string> stage_names() const { return {}; }
  /// Returns one line about the device: "NVIDIA H200, CUDA 13.0" or "2 threads".
  virtual std::string device() const = 0;
};

/// Reports a contestant that gave no answer because it crashed, hung, or wrote outside its arrays. The judge then
/// searches for the case that caused it and continues. Any other exception of a contestant ends the comparison.
struct ContestantFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Holds a contestant's stages; an empty function means that the contestant lacks the stage. Inputs and outputs are
/// only forward declared here, so that a change of one stage recompiles only the code of that stage. Code that makes or
/// calls a stage includes its header.
struct Contestant {
  std::string name;  ///< name in reports
  /// Whether its steps implement bounds=planes and bounds=dat. False for plug-ins: the trace in compare/plugin.h has no
  /// planes.
  bool has_steps_with_planes = true;
  /// Whether its planes divide a gap by the approach of both sides (bounds=dat). False for plug-ins: compare/plugin.h
  /// has no displacements.
  bool divides_by_approach = true;
  /// Whether the judge tests it with volumes that have cavities. False for plug-ins: compare/plugin.h cannot describe
  /// cavities.
  bool has_cavities = true;
  /// Whether its sweeps and steps handle volumes. False for plug-ins: sweeps and steps in compare/plugin.h have no
  /// contacts with volumes.
  bool has_volumes = true;
  /// Whether its rest states, guesses, sweeps and steps handle rods. False for plug-ins: these stages have no segments
  /// in compare/plugin.h.
  bool has_rods = true;
  /// One function for each stage; compare/stages/STAGE.hpp has its contract.
  std::function<ClosestFaceOut(const ClosestFaceIn&)> closest_face;
  std::function<ClosestPointsOut(const ClosestPointsIn&)> closest_points;
  std::function<DetectVertexFacetOut(const DetectIn&)> detect_vertex_facet;
  std::function<DetectEdgeEdgeOut(const DetectIn&)> detect_edge_edge;
  std::function<BoundOut(const BoundIn&)> bound;
  std::function<PlaneOut(const PlaneIn&)> plane;
  std::function<VolumeDepthOut(const VolumeDepthIn&)> volume_depth;
  std::function<ActivationOut(const ActivationIn&)> activation;
  std::function<BarrierOut(const BarrierIn&)> barrier;
  std::function<CcdOut(const CcdIn&)> ccd;
  std::function<TruncateOut(const TruncateIn&)> truncate;
  std::function<ForceOut(const MembraneIn&)> membrane;
  std::function<ForceOut(const BendingIn&)> bending;
  std::function<ForceOut(const SpringIn&)> spring;
  std::function<ForceOut(const TetrahedronIn&)> tetrahedron;
  std::function<ForceOut(const RodIn&)> rod;
  std::function<OrientationOut(const OrientationIn&)> orientation;
  std::function<ForceOut(const ContactForceIn&)> contact_force;
  std::function<ForceOut(const FrictionForceIn&)> friction_force;
  std::function<ForceOut(const VolumeForceIn&)> volume_force;
  std::function<BlockOut(const BlockIn&)> block;
  std::function<RestStateOut(const RestStateIn&)> rest_state;
  std::function<InitialGuessOut(const InitialGuessIn&)> initial_guess;
  std::function<SweepOut(const SweepIn&)> sweep;
  std::function<StepOut(const StepIn&)> step;
  std::function<std::unique_ptr<Simulation>(const Scene&, const SimulationOptions&)> start;
};

/// Calls visit(name, pointer to member) for each stage that a contestant may have. A stage has the name of its header
/// in compare/stages. A check compares the judge's list of stages with this one (compare/judge/engine/judge.cpp).
template <class Visit>
constexpr void visit_stages(Visit visit) {
  visit("closest_face", &Contestant::closest_face);
  visit("closest_points", &Contestant::closest_points);
  visit("block", &Contestant::block);
  visit("detect_vertex_facet", &Contestant::detect_vertex_facet);
  visit("detect_edge_edge", &Contestant::detect_edge_edge);
  visit("bound", &Contestant::bound);
  visit("plane", &Contestant::plane);
  visit("volume_depth", &Contestant::volume_depth);
  visit("initial_guess", &Contestant::initial_guess);
  visit("activation", &Contestant::activation);
  visit("barrier", &Contestant::barrier);
  visit("contact_force", &Contestant::contact_force);
  visit("friction_force", &Contestant::friction_force);
  visit("volume_force", &Contestant::volume_force);
  visit("membrane", &Contestant::membrane);
  visit("bending", &Contestant::bending);
  visit("spring", &Contestant::spring);
  visit("tetrahedron", &Contestant::tetrahedron);
  visit("rod", &Contestant::rod);
  visit("orientation", &Contestant::orientation);
  visit("ccd", &Contestant::ccd);
  visit("truncate", &Contestant::truncate);
  visit("rest_state", &Contestant::rest_state);
  visit("sweep", &Contestant::sweep);
  visit("step", &Contestant::step);
}

/// Holds the contestant that is right. Its answers also contain what the judge needs to decide about grey cases and
/// conditioning.
struct Authority {
  std::string name;  ///< name in reports
  /// One function for each stage, as in Contestant.
  std::function<ClosestFaceTruth(const ClosestFaceIn&)> closest_face;
  std::function<ClosestPointsTruth(const ClosestPointsIn&)> closest_points;
  std::function<DetectVertexFacetTruth(const DetectIn&)> detect_vertex_facet;
  std::function<DetectEdgeEdgeTruth(const DetectIn&)> detect_edge_edge;
  std::function<BoundTruth(const BoundIn&)> bound;
  std::function<VolumeDepthTruth(const VolumeDepthIn&)> volume_depth;
  std::function<ActivationTruth(const ActivationIn&)> activation;
  std::function<BarrierTruth(const BarrierIn&)> barrier;
  std::function<CcdTruth(const CcdIn&)> ccd;
  std::function<TruncateTruth(const TruncateIn&)> truncate;
  std::function<ForceTruth(const MembraneIn&)> membrane;
  std::function<ForceTruth(const BendingIn&)> bending;
  std::function<ForceTruth(const SpringIn&)> spring;
  std::function<ForceTruth(const TetrahedronIn&)> tetrahedron;
  std::function<ForceTruth(const RodIn&)> rod;
  std::function<OrientationTruth(const OrientationIn&)> orientation;
  std::function<ForceTruth(const ContactForceIn&)> contact_force;
  std::function<ForceTruth(const FrictionForceIn&)> friction_force;
  std::function<ForceTruth(const VolumeForceIn&)> volume_force;
  std::function<BlockTruth(const BlockIn&)> block;
  std::function<RestStateTruth(const RestStateIn&)> rest_state;
  std::function<InitialGuessTruth(const InitialGuessIn&)> initial_guess;
  /// In the stages plane, sweep and step the truth depends on the answer (compare/stages/plane.hpp, sweep.hpp,
  /// step.hpp).
  std::function<PlaneTruth(const PlaneIn&, const PlaneOut&)> plane;
  std::function<SweepTruth(const SweepIn&, const SweepOut&)> sweep;
  std::function<StepTruth(const StepIn&, const StepOut&)> step;
};

}  // namespace ogc::compare
