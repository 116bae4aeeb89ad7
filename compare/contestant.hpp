// A contestant: a name, a callable for each stage that it has, and a resident simulation. The judge drives two of them
// through the same cases and never learns who they are.
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

/// Why a step is not clean; bits of StepMetrics::status.
enum StepStatus : std::uint32_t {
  step_clean = 0,
  step_list_grew = 1,       ///< a list was too small: it grew and the step was repeated
  step_not_finite = 2,      ///< a position became NaN or infinite: the run stops, the last good state stays
  step_bound_violated = 4,  ///< the motion certificate failed: ‖x − x_prev‖ > b_v in double
  /// the solver's iterations ended above its tolerance: the run stops, the last good state stays
  step_not_converged = 8,
  step_indefinite = 16,  ///< the solver's matrix is not positive definite, or no step lowers the energy: likewise
  step_met = 32,         ///< faces met on the way, though bounds forbid it (compare/oracle/meetings.hpp)
};

/// One row of iterations.csv, by solvers that keep one. The state is the one that the iteration begins with, or (the
/// last row of a step) ends at.
struct IterationMetrics {
  std::int64_t step = 0, iteration = 0;  ///< from 1; from 0 in each step
  double wall_ms = 0;                    ///< since the step began
  double residual = 0;                   ///< Eq. 29 with the contacts of the last detection
  double energy = 0;                     ///< incremental potential with these contacts [J]
  double largest_change = 0;             ///< ‖δ‖_∞ of the solve, before any truncation [m]
  double share = 0;                      ///< of δ' that the line search took, 0 where no step was taken
  std::int64_t vertices_cut = 0;         ///< cut in this iteration
  std::int64_t detected = 0;             ///< 1 where contacts were detected anew for this state
  double condition_number = 0;           ///< of the matrix; not-a-number where it was not asked for
  /// Of the matrix without friction, and without contact and friction: with stencils projected where the rest is not
  /// positive definite.
  double condition_without_friction = 0, condition_without_contact = 0;
  /// of this iteration, counted as in StepMetrics
  std::int64_t broad_phases = 0, discrete_detections = 0, continuous_detections = 0;
};

/// What the parts of a step do to energy and momentum: columns of steps.csv with `ogc run --ledger`
/// (reference/ledger.md). Energies are changes but for the start's [J]; momenta and motions, free vertices' [kg m/s].
struct StepLedger {
  double energy_start = 0;                                                   ///< at xᵗ with vᵗ
  double energy_guess = 0, energy_detection = 0;                             ///< rounds; contacts found anew
  double energy_sweep = 0, energy_truncation = 0;                            ///< to proposals; from there to x
  double energy_commit = 0;                                                  ///< to the start of the next step
  Vec3 momentum_start, momentum_guess, momentum_sweep, momentum_truncation;  ///< Σ m v, and changes of it
  double motion_proposed = 0, motion_taken = 0;                              ///< of sweeps; by truncation of that
  double motion_taken_tangential = 0, motion_taken_leaving = 0;              ///< along and off the nearest pair
  double motion_taken_unpaired = 0;                                          ///< where no pair lies within r_q
  double vertices_still = 0, vertices_held = 0;  ///< end where they began; of them those that truncation held there
};

/// One row of steps.csv. Times [ms]; not-a-number where a quantity was not asked for.
struct StepMetrics {
  std::int64_t step = 0;  ///< number of the step that this row ends, from 1
  /// CPU: steady clock; CUDA: device events over the frame, divided by its steps
  double wall_ms = 0;
  std::int64_t vertex_facet_contacts = 0, edge_edge_contacts = 0;  ///< at the last detection
  /// trees brought up to date (built or refitted) and asked for all pairs once
  std::int64_t broad_phases = 0;
  /// contacts or distances of all pairs found at one state; a check that only guards one is none
  std::int64_t discrete_detections = 0;
  /// the first contact of all pairs, or of the active ones, found along one motion
  std::int64_t continuous_detections = 0;
  std::int64_t guess_rounds = 0, iterations = 0;
  std::int64_t vertices_cut = 0;                          ///< cut in the last iteration
  double share_cut = 0;                                   ///< vertices_cut / K
  double momentum_lost_guess = 0, momentum_lost_end = 0;  ///< ‖Σ m (x − y)‖ / ‖Σ m (y − xᵗ)‖ (method.md §5.3)
  double largest_lag = 0;                                 ///< of prescribed vertices behind their targets [m]
  double query_radius = 0;                                ///< r_q of the step [m]
  double residual = 0;                                    ///< Eq. 29
  /// √(Σ m ‖Δx‖²) of free vertices in the last sweep or iteration, over that of the step; 0 where nothing moves [1]
  double last_motion = std::numeric_limits<double>::quiet_NaN();
  /// Eq. 29 with the step's own contacts, over free vertices that no bound holds, and what of it may come from rounded
  /// positions [1]; free vertices that a bound holds. In some steps alone (method.md §6).
  double left_residual = std::numeric_limits<double>::quiet_NaN(),
         left_rounding = std::numeric_limits<double>::quiet_NaN(), left_held = std::numeric_limits<double>::quiet_NaN();
  double kinetic_energy = 0, elastic_energy = 0, contact_energy = 0, gravity_energy = 0;  ///< [J]
  double smallest_distance = 0;          ///< smallest d_min at the last detection (r_q where nothing is near) [m]
  std::int64_t inverted_tetrahedra = 0;  ///< with J ≤ 0 at the end of the step
  /// at the last detection: contacts with volumes, vertices that ask and have one inside, and how far the deepest of
  /// them is from the surface [m]; sheets of tetrahedra around them without any way out
  std::int64_t volume_contacts = 0, vertices_inside = 0;
  double deepest = 0;
  std::int64_t depth_unresolved = 0;
  /// pairs of faces that shared a point on the way (compare/meetings.md)
  double meetings = std::numeric_limits<double>::quiet_NaN();
  /// of scenes with rods, at the end: smallest distance of contacts that act (not-a-number: none does) [m], mean and
  /// largest ‖D‖/l − 1 of the segments [1]
  double smallest_contact_distance = 0, mean_stretch = 0, largest_stretch = 0;
  std::int64_t repeats = 0;  ///< times the step was repeated because a list grew
  std::uint32_t status = step_clean;
  std::optional<StepLedger> ledger{};  ///< where it was asked for
  /// what the solver ran into, by name, and how it went on; shown to the user, not in steps.csv
  std::vector<std::string> notes;
  std::vector<IterationMetrics> iteration_rows;  ///< with SimulationOptions::iterations
  /// with profile: time by stage, in the order of Simulation::stage_names()
  std::vector<double> stage_ms;
};

/// State at the end of a step, with what the motion certificate needs.
struct Snapshot {
  std::int64_t step = 0;                     ///< the step that it ends
  std::vector<Vec3f> positions, velocities;  ///< [m], [m/s]
  std::vector<Vec3f> previous;               ///< X_prev of the last detection
  std::vector<float> bounds;                 ///< b_v of the last detection
  float query_radius = 0;                    ///< r_q of the last detection
  /// of lists that grow, in the contestant's own order: they decide which step is repeated, and no position
  std::vector<std::int64_t> capacities{};
  /// of a solver whose state is in double: what positions and velocities are rounded from; else none
  std::vector<Vec3> exact_positions{}, exact_velocities{};
  VertexPlanes planes{};  ///< of the last detection, where bounds are planes
  /// of the segments of rods, in the order of rod_segments (compare/problem/rods.hpp)
  std::vector<Quaternion> orientations{};
};

/// What a simulation records beside its states.
struct SimulationOptions {
  bool profile = false;     ///< record times by stage (adds synchronisations)
  bool energies = true;     ///< fill the energies of StepMetrics
  bool iterations = false;  ///< fill StepMetrics::iteration_rows, where the solver keeps them
  bool condition = false;   ///< with a solver that factorises: the condition number in each iteration row (slow)
};

/// A simulation that lives where the contestant computes; nothing of it is copied to the host except on request.
class Simulation {
 public:
  virtual ~Simulation() = default;
  /// Runs `steps` steps (a frame); returns one row each. Stops early after a row whose status says not_finite or
  /// bound_violated.
  virtual std::vector<StepMetrics> advance(std::int64_t steps) = 0;
  virtual Snapshot snapshot() = 0;
  /// Continues from positions, velocities, orientations and step number, with room for `capacities` where there are
  /// any; what else a snapshot holds is recomputed.
  virtual void restore(const Snapshot& snapshot) = 0;
  virtual std::vector<std::string> stage_names() const { return {}; }
  /// One line on where it runs: "NVIDIA H200, CUDA 13.0" or "2 threads".
  virtual std::string device() const = 0;
};

/// A contestant that gave no answer: it crashed, hung, or wrote where it must not. The judge looks for the case that
/// did it and goes on; whatever else a contestant throws ends the comparison.
struct ContestantFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Empty functions are stages that the contestant does not have. A file that makes or
/// calls one includes that stage's header: here questions and answers are declared alone, so that a change of one stage
/// compiles what reads that stage again, and not what holds a contestant.
struct Contestant {
  std::string name;  ///< for reports
  /// Whether its steps know bounds=planes and bounds=dat. A plug-in's do not: compare/plugin.h has no planes in its
  /// trace.
  bool has_steps_with_planes = true;
  /// Whether its planes divide gaps by approach. A plug-in's do not: compare/plugin.h has no displacements there.
  bool divides_by_approach = true;
  /// Whether it is asked about volumes with cavities. A plug-in is not: compare/plugin.h describes none.
  bool has_cavities = true;
  /// Whether its sweeps and steps know volumes. A plug-in's do not: compare/plugin.h has no contacts with them there.
  bool has_volumes = true;
  /// Whether its rest states, guesses, sweeps and steps know rods. A plug-in's do not: compare/plugin.h has no
  /// segments there.
  bool has_rods = true;
  /// By stage: compare/stages/STAGE.hpp says what is asked.
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

/// Calls visit(name, pointer to member) for each stage that a contestant may have; the names are those of
/// compare/stages. The judge's list of stages is held to this one (compare/judge/engine/judge.cpp).
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

/// The contestant that is right: its answers carry what the judge needs to decide about grey cases and conditioning.
struct Authority {
  std::string name;  ///< for reports
  /// By stage, as for a contestant.
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
  /// Of plane, sweep and step the truth follows the answer (compare/stages/plane.hpp, sweep.hpp, step.hpp).
  std::function<PlaneTruth(const PlaneIn&, const PlaneOut&)> plane;
  std::function<SweepTruth(const SweepIn&, const SweepOut&)> sweep;
  std::function<StepTruth(const StepIn&, const StepOut&)> step;
};

}  // namespace ogc::compare
