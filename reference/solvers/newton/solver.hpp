// Newton-OGC: Algorithm 3 with Newton's method for its solve. A step is
//
//   detect at xᵗ ── guess loop (Eq. 28, method.md §5) ── friction lagged ── detect ──┐
//        ┌───────────────────────────────────────────────────────────────────────────┘
//        ▼
//     prescribed vertices to their targets, truncated ── gradient, Hessian ── residual ≤ tolerance? ──┐
//        ▲                                                                                            ▼
//        │                                                 backtrack (method.md §7.6) ── truncate δ ── solve
//        └── detect again when vertices were cut, or to judge the residual ──┘
//
// Choices that the paper leaves open. The guess loop ends at the first contact; a step that begins with contacts begins
// at xᵗ. The loop moves vertices one by one: those in contact would stay while the others cross several balls, and the
// mesh would be crumpled, with distances so small that no ball lets it unfold. Newton's own steps cross as many balls,
// but move everything together. Friction of the first solve is lagged to xᵗ, where contact forces are those of a
// converged step. Contacts are detected once more after a guess: the reference residual f* of Eq. 29 needs them, and
// the solve begins with full balls. A solve to a tolerance detects again as soon as one vertex was cut, as method.md §6
// requires of all runs to convergence: a vertex that its ball holds back would keep the residual up forever. Without a
// tolerance γ_e decides alone. The solve takes prescribed vertices where they are and never waits for them: where
// bounds keep one from its target it lags, as in the fast path.
//
// Where balls cut δ there are three directions, each backtracked (method.md §7.6); the one that lowers the energy most
// is taken:
//   δ'      δ, cut vertex by vertex. In a crumpled cloth it bends whatever lies between a vertex that was cut and one
//           that was not, and a share of 2⁻⁸ that lowers the energy in its seventh digit would pass for progress;
//   scaled  δ, scaled to fit all balls. It must lower the energy twice as much as δ', which moves most vertices far and
//           makes room for all: without this factor sheets that fly together or are nearly closed lose the full steps
//           that tests/reference/solvers/newton/solver.cpp requires;
//   pinned  δ of a system with springs on cut vertices. Where two near vertices want to travel together, truncation
//           also takes a part of their separation: each keeps a share of its δ, and so of the difference of both. The
//           springs hold cut vertices where they are, with stiffness (‖δ_v‖/‖δ'_v‖ − 1)(m_v/h² + earlier stiffness);
//           the system is solved and truncated again, so that free vertices take the held ones into account. A vertex
//           that only inertia holds goes exactly as far as its ball allows. Rounds go on while they lower the energy
//           more. Where all vertices were cut, `scaled` does the same.
// A line search that takes less than 10⁻³ of a step triggers a detection, for new balls.
//
// Balls and half-spaces stand still, so that vertices which travel together, or along each other, need as many
// detections as their gap goes into their way. With `newton_truncation=pair` near pairs are held apart by planes that
// travel with them (moving_planes.hpp), and δ' is δ with such pairs moved apart. The guess loop keeps its balls; a step
// ends with a detection at what it stores.
//
// Stencils are projected where the matrix is not positive definite without projection, and where the last step was cut:
// far from the solution the matrix rarely is definite. With projection in every iteration a step of a crumpled cloth
// ends in a long linear tail, because the projection keeps curvature that other stencils cancel.
//
// With NewtonSteps::whole there is none of this: each iteration detects, solves and takes the whole step, whatever it
// does to the energy and whatever it passes through, and a step ends at the tolerance or with its last iteration. That
// is the usual solve of a penalty method, a baseline.
//
// OGC's force jumps where a contact point leaves its block for one that is not in contact (Fig. 22). So there may be no
// state whose force vanishes with the contacts detected at it: solves then alternate between two sets of contacts, each
// converged with its own, or stop at a kink of one set (crossing strands that are nearly parallel jump from one pair of
// closest points to another). After a few of these rounds that don't halve the residual found there the step ends, with
// the residual of the contacts at its end, above the tolerance; steps.csv shows it.
#pragma once

#include <functional>
#include <optional>

#include "reference/solvers/contact_step.hpp"
#include "reference/solvers/newton/factor.hpp"
#include "reference/solvers/newton/line_search.hpp"
#include "reference/solvers/newton/moving_planes.hpp"
#include "reference/solvers/newton/settings.hpp"

namespace ogc::reference {

/// What Newton's method does with its direction.
enum class NewtonSteps {
  searched,  ///< truncates the direction and searches along it
  whole      ///< takes the whole direction: a baseline without bounds
};

/// Newton-OGC (method.md §7.6).
class NewtonSolver : public StepSolver, private ContactStep {
 public:
  /// The scene must be rounded and valid; scene and topology must outlive this.
  NewtonSolver(const compare::Scene& scene, const compare::Topology& topology,
               const compare::SimulationOptions& options, NewtonSteps steps = NewtonSteps::searched);

  StepResult step(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
                  std::int64_t number) override;
  void set_orientations(std::span<const compare::Quaternion> orientations) override;
  std::vector<compare::Quaternion> orientations() const override;
  std::vector<std::string> stage_names() const override;

  /// Called for each accepted step of the line search: energy before it, change of the energy, and rounding noise [J],
  /// with the same contacts and friction before and after.
  std::function<void(double before, double change, double noise)> on_accepted;

 private:
  enum Stage : std::size_t {
    detection = detection_stage,
    derivation,
    assembly,
    factorization,
    line_search,
    stage_count
  };
  enum class Outcome { converged, iteration_limit, indefinite, no_decrease, not_finite };
  struct Direction {
    State delta;         ///< of all vertices [m], then of all segments [1]; 0 where not free
    State truncated;     ///< δ'
    double largest = 0;  ///< ‖δ‖_∞ [m]
    std::size_t cut = 0;
  };

  std::uint32_t status_of(Outcome outcome) const;
  Outcome solve();
  Outcome solve_once();
  /// Does one round of the loop; returns empty where the solve goes on.
  std::optional<Outcome> iterate();
  std::optional<Outcome> advance(std::size_t prescribed_cut);
  bool judged_in_vain(double force);
  double mean_force() const;
  bool has_small_torque();
  /// Returns x, followed by ω = 0 of each segment of a rod.
  State unknowns() const;
  void derive(HessianProjection projection);
  /// Factorises the matrix; with projected stencils where it is not positive definite without.
  bool factorized_definite();
  bool factorized();
  /// Fills the condition numbers of the present matrix, which is factorised, and of its parts without friction and
  /// without contact.
  void measure_condition(compare::IterationMetrics& row);
  void detect_with_planes();
  /// Moves prescribed vertices towards their targets, as far as planes allow; returns how many lag.
  std::size_t move_prescribed_between_planes();
  std::uint32_t end_between_planes(std::uint32_t status);
  Direction direction_of();
  void truncate(Direction& direction) const;
  /// Returns the share of δ, scaled as a whole, that stays inside.
  double room_for(const State& delta) const;
  bool pin(const Direction& direction, std::vector<double>& pins);
  Accepted pinned(Direction direction, const PotentialTerms& before, double noise);
  /// Moves along the best direction; returns the share of it that was taken, or 0.
  double accepted_share(const Direction& direction);
  /// Takes the whole direction; returns 1.
  double whole_step(const Direction& direction);
  /// Moves to these unknowns.
  void move_to(State all);
  Accepted searched(const Direction& direction, const PotentialTerms& before, double noise) const;

  NewtonSettings newton_;
  NewtonSteps steps_;
  MovingPlanes planes_;  ///< of the last detection, with newton_truncation=pair
  BlockMatrix matrix_;
  Factor factor_;
  PotentialDerivatives derivatives_;  ///< of the last iteration
  /// whether contacts are detected to judge a solve that has converged with the contacts before: next, and now
  bool judge_next_ = false, judging_ = false;
  HessianProjection projection_ = HessianProjection::none;  ///< of derivatives_
  int judgements_ = 0;                                      ///< judgements that did not halve the force
  double least_judged_ = 0;                                 ///< least force that a judgement found [N]
  double reference_torque_ = -1;  ///< Σ ‖∂E/∂ω‖ after the guess [N m]; negative where not yet known
  bool pattern_stale_ = true;
};

}  // namespace ogc::reference
