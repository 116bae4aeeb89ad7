// IPC (Li et al. 2020, Algorithm 1; choices of the official code), a step of implicit Euler:
//
//   barriers at xᵗ ── κ ── friction lagged ── prescribed vertices to their targets as far as CCD allows ──┐
//        ┌────────────────────────────────────────────────────────────────────────────────────────────────┘
//        ▼
//     derivatives ── solve for p ── bound by CCD ── halve until the energy falls and nothing intersects ──┐
//        ▲                                                                                                ▼
//        └──────────────────────── adapt κ, or the pull ─────────────────────────────────────── p small? ─┘
//
// The step is bounded as in the official code: by CCD of the active pairs, and by a largest motion of d̂/2 for all
// other pairs (a CFL-like rule). If this motion is less than half of what CCD allows, CCD of all pairs replaces the
// rule. One broad phase serves an iteration: its boxes hold the whole motion and reach d̂ further. So it finds the
// pairs for the continuous detection and for the barriers of every trial state.
//
// If the line search accepts less than 1e-10 of p, the next direction is the negative gradient divided by the diagonal.
// If this direction also stalls, the time step ends without convergence. The notes of the step get each of these
// events, with the pair that caused it.
//
// Positions are doubles in all steps, because rounding could remove a gap. Positions in files are rounded.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <optional>

#include "compare/contestant.hpp"
#include "reference/ipc/forces.hpp"
#include "reference/ipc/settings.hpp"
#include "reference/ipc/step_bound.hpp"
#include "reference/ipc/stiffness.hpp"
#include "reference/solvers/newton/factor.hpp"
#include "reference/solvers/newton/settings.hpp"

namespace ogc::reference {

/// The phases into which the time of a step is divided.
enum class IpcStage : std::uint8_t {
  broad_phase,
  barriers,
  derivatives,
  assembly,
  factorization,
  ccd,
  line_search,
  guard
};
inline constexpr std::size_t ipc_stage_count = 8;  ///< number of phases
/// Returns the names in the order of IpcStage.
std::vector<std::string> ipc_stage_names();

/// Positions [m] and velocities [m/s] at the end of a step. If the step failed, they must not be used.
struct IpcStep {
  State position, velocity;
  compare::StepMetrics metrics;
};

/// Simulates one scene, step by step.
class IpcSolver {
 public:
  /// The scene must be rounded and valid; scene and topology must outlive this.
  IpcSolver(const compare::Scene& scene, const compare::Topology& topology, const compare::SimulationOptions& options);

  /// Throws compare::InputError with the pairs that intersect or have no gap at x.
  void check_start(const State& x) const;
  /// Sets qᵗ of the next step; an empty span selects the orientations of the scene's start.
  void set_orientations(std::span<const compare::Quaternion> orientations);
  std::vector<compare::Quaternion> orientations() const;
  /// Computes step `number`; the first step has number 1. Throws compare::ResourceError if memory runs out.
  IpcStep step(const State& start, const State& velocity, std::int64_t number);

  /// Returns d̂ and ξ.
  const BarrierShape& shape() const { return shape_; }
  /// Returns the limits of κ's adaptation.
  const StiffnessBounds& stiffness_bounds() const { return bounds_; }
  double stiffness() const { return stiffness_; }  ///< present κ [J/m⁴]
  /// Called for each accepted step of the line search. `change` is the energy's change at constant κ, `noise` its
  /// rounding error [J].
  std::function<void(double change, double noise)> on_accepted;

 private:
  enum class Outcome { converged, limit, indefinite, stuck, not_finite };
  /// The linear system of the free vertices and frames; with a pull, it includes the prescribed vertices.
  struct System {
    BlockMatrix matrix;
    Factor factor;
    explicit System(const std::vector<Mobility>& mobility) : matrix(mobility) {}
  };
  struct Bounded {
    double share = 1;
    std::optional<PrimitivePair> pair;
    std::vector<PrimitivePair> pairs;  ///< all pairs that can come within d̂ during the motion
  };

  void begin(const State& start, const State& velocity, std::int64_t number);
  void find_barriers(const State& x);
  void start_stiffness();
  void move_prescribed();
  Outcome solve();
  Outcome solve_once();
  /// Runs one iteration. Returns the outcome of the solve, or nothing if the solve continues.
  std::optional<Outcome> iterate();
  bool take(const State& p, bool is_last);
  std::optional<State> direction();
  bool converged(const State& p);
  bool pulled_home();
  State as_motion(State p) const;
  State of_vertices(const State& p) const;
  State with_frames(State x, double share, const State& p) const;
  Bounded bounded(const State& p);
  double searched(const State& p, const Bounded& bound);
  bool intersects(const State& x);
  void adapt_stiffness();
  void release_pull();
  void note(const std::string& what);
  void add_row();
  void count_by_iteration();
  double elapsed_ms() const;  ///< time since the step began
  IpcStep finish(Outcome outcome);
  System& system();
  std::vector<PrimitivePair> near(const State& from, const State& to);

  template <class Work>
  auto timed(IpcStage stage, Work work);

  const compare::Scene& scene_;
  const compare::Topology& topology_;
  const compare::Settings& settings_;
  IpcSettings ipc_;
  NewtonSettings newton_;  ///< only friction_solves and projection are used
  compare::SimulationOptions options_;
  compare::Exclusions exclusions_;
  BarrierShape shape_;
  StiffnessScale scale_;
  IpcForces forces_;
  PairMesh mesh_;
  double moving_diagonal_;  ///< unit of length of a step's tolerance [m]
  StiffnessBounds bounds_;
  StiffnessGuard guard_;
  System free_;
  std::unique_ptr<System> pulled_;  ///< built when a pull first needs it

  State start_, target_, x_;
  BarrierSet set_;              ///< the barriers at x
  IpcDerivatives derivatives_;  ///< derivatives of the last iteration
  double stiffness_ = 0;
  double prescribed_way_ = 0;    ///< Σ ‖t − xᵗ‖² of prescribed vertices [m²]
  std::int64_t iterations_ = 0;  ///< iterations of the current solve
  bool descend_ = false;         ///< the next direction is the negative gradient
  std::deque<double> speeds_;    ///< mean squared ‖p_v‖/h of the last iterations [m²/s²]
  double started_ms_ = 0;
  compare::StepMetrics metrics_;
  std::vector<compare::IterationMetrics> rows_;
  std::array<double, ipc_stage_count> stage_ms_{};
};

}  // namespace ogc::reference
