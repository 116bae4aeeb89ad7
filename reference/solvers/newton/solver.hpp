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
// at xᵗ. The loop moves vertices one by one: those in contact stay while the others cross several balls, and what is
// left is crumpled, with distances so small that no ball lets it unfold. Newton's own steps cross as many balls, but
// move everything together. Friction of the first solve is lagged to xᵗ, where contact forces are those of a converged
// step. Contacts are detected once more after a guess: the reference residual f* of Eq. 29 asks for them, and the solve
// begins with full balls. A solve to a tolerance detects again as soon as one vertex was cut, as method.md §6 asks of
// all that is run to convergence: a vertex that its ball holds back would keep the residual up for good. Without a
// tolerance γ_e decides alone. The solve takes prescribed vertices as they are and never waits for them: where bounds
// keep one from its target it lags, as in the fast path.
//
// Where balls cut δ there are three ways to go, each backtracked (method.md §7.6), and the one that lowers the energy
// most is taken:
//   δ'      cut vertex by vertex. In a crumpled cloth it bends whatever stands between a vertex that was cut and one
//           that was not, and a share of 2⁻⁸ that lowers the energy in its seventh digit would pass for progress;
//   scaled  δ, scaled to fit all balls. It must lower the energy twice as much as δ', which moves most vertices far and
//           makes room for all: with no such factor sheets that fly together or are nearly closed lose the full steps
//           that tests/reference/solvers/newton/solver.cpp asks for;
//   pinned  truncation takes from two near vertices that want common travel their separation, too: each keeps a share
//           of its δ, and so of the difference of both. So springs hold cut vertices where they are, of stiffness
//           (‖δ_v‖/‖δ'_v‖ − 1)(m_v/h² + what they had), and the system is solved and truncated again: vertices that are
//           free to go take into account what the others may not. What only inertia holds goes just as far as its ball
//           allows. Rounds go on while they lower the energy more. Where all vertices were cut `scaled` does the same.
// A line search that leaves less than 10⁻³ of a step with cut vertices asks for new balls.
//
// Balls and half-spaces stand still, so that vertices which travel together, or along each other, need as many
// detections as their gap goes into their way: with `truncation=pair` near pairs are held apart by planes that travel
// with them (moving_planes.hpp), and δ' is δ with such pairs moved apart. The guess loop keeps its balls; a step ends
// with a detection at what it stores.
//
// Stencils are projected where the matrix is not positive definite without it, and where the last step was cut: far
// from the solution it rarely is. Always projected, a step of a crumpled cloth ends in a long linear tail, for the
// projection keeps curvature that other stencils cancel.
//
// With NewtonSteps::whole there is none of all this: each iteration detects, solves and takes the whole step, whatever
// it does to the energy and whatever it passes through, and a step ends at the tolerance or with its last iteration.
// That is the usual solve of a penalty method, a baseline.
//
// OGC's force jumps where a contact point leaves its block for one that is not in contact (Fig. 22), so that there may
// be no state at all whose force vanishes with the contacts detected at it: solves then alternate between two sets of
// contacts, each converged with its own, or come to a standstill at a kink of one: strands that cross, nearly parallel,
// jump from one pair of closest points to another. After a few of these rounds that don't halve the residual found
// there the step ends, with the residual of the contacts at its end, above the tolerance: steps.csv shows it.
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
  searched,  ///< truncates it and searches along it
  whole      ///< takes it: a baseline without bounds
};

/// Newton-OGC (method.md §7.6).
class NewtonSolver : public StepSolver, private ContactStep {
 public:
  /// Scene: rounded and valid. Both must outlive it.
  NewtonSolver(const compare::Scene& scene, const compare::Topology& topology,
               const compare::SimulationOptions& options, NewtonSteps steps = NewtonSteps::searched);

  StepResult step(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
                  std::int64_t number) override;
  void set_orientations(std::span<const compare::Quaternion> orientations) override;
  std::vector<compare::Quaternion> orientations() const override;
  std::vector<std::string> stage_names() const override;

  /// Called with each accepted step of the line search: energies before and after, with the same contacts and friction
  /// [J].
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
  /// One round of the loop; empty where it goes on.
  std::optional<Outcome> iterate();
  std::optional<Outcome> advance(std::size_t prescribed_cut);
  bool judged_in_vain(double force);
  double mean_force() const;
  bool has_small_torque();
  /// x, and behind it ω = 0 of each segment of a rod.
  State unknowns() const;
  void derive(HessianProjection projection);
  /// With stencils projected where the matrix of these derivatives is not positive definite.
  bool factorized_definite();
  bool factorized();
  /// Of the matrix at hand, which is factorised, and of what is left of it without friction and without contact.
  void measure_condition(compare::IterationMetrics& row);
  void detect_with_planes();
  /// Towards their targets, as far as planes allow; how many lag.
  std::size_t move_prescribed_between_planes();
  std::uint32_t end_between_planes(std::uint32_t status);
  Direction direction_of();
  void truncate(Direction& direction) const;
  /// The share of δ that stays inside, scaled as a whole.
  double room_for(const State& delta) const;
  bool pin(const Direction& direction, std::vector<double>& pins);
  Accepted pinned(Direction direction, const PotentialTerms& before, double noise);
  /// The share of the best direction that was taken, or 0.
  double accepted_share(const Direction& direction);
  /// All of the direction; 1.
  double whole_step(const Direction& direction);
  /// To these unknowns.
  void move_to(State all);
  Accepted searched(const Direction& direction, const PotentialTerms& before, double noise) const;

  NewtonSettings newton_;
  NewtonSteps steps_;
  MovingPlanes planes_;  ///< of the last detection, where pairs are held
  BlockMatrix matrix_;
  Factor factor_;
  PotentialDerivatives derivatives_;  ///< of the last iteration
  /// contacts are detected to judge a solve that has converged with those before
  bool judge_next_ = false, judging_ = false;
  HessianProjection projection_ = HessianProjection::none;  ///< of derivatives_
  int judgements_ = 0;                                      ///< without a smaller force than before
  double least_judged_ = 0;                                 ///< [N]
  double reference_torque_ = -1;  ///< Σ ‖∂E/∂ω‖ after the guess [N m]; negative before
  bool pattern_stale_ = true;
};

}  // namespace ogc::reference
