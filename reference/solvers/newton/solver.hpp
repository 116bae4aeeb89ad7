// Newton-OGC: Algorithm 3 with Newton's method for its solve (method.md §7.6). A step is
//
//   detect at xᵗ ── guess loop (Eq. 28, method.md §5.2) ── lag friction ── detect ── (A)
//
//   (A) move prescribed vertices to their targets, truncated
//       gradient and Hessian; if the residual is at most the tolerance: end if contacts are new, else detect for (A)
//       solve for δ ── truncate δ to δ' ── backtrack along δ'
//       detect if a vertex was cut ── repeat from (A)
//
// Choices that the paper leaves open:
//
// - The guess loop ends at the first contact, and a step that begins with contacts begins at xᵗ. The loop moves
//   vertices one by one: vertices in contact would stay while others cross several balls. This would crumple the mesh
//   and leave distances, hence balls, that are too small to unfold it. Newton's steps cross as many balls, but move all
//   vertices together.
// - Friction of the first solve is lagged to xᵗ, where contact forces are those of a converged step.
// - Contacts are detected again after the guess: the force f* of Eq. 29 needs them, and each vertex is then at the
//   centre of its ball.
// - A solve to a tolerance detects again as soon as one vertex was cut (method.md §6). Otherwise a vertex at the limit
//   of its ball could keep the residual above the tolerance. Without a tolerance only γ_e decides.
// - The solve does not wait for prescribed vertices. If bounds keep such a vertex from its target, it lags.
//
// If balls cut δ, up to three directions are backtracked. The one that lowers the energy most is taken:
//
//   δ'      δ, cut vertex by vertex. In a crumpled cloth δ' bends the mesh between cut and uncut vertices. A share of
//           2⁻⁸ that lowers the energy in its seventh digit would then count as progress.
//   scaled  δ, scaled to fit all balls. It must lower the energy twice as much as δ', because δ' moves most vertices
//           far and so makes new balls larger. Without this factor, sheets that fly together or almost touch lose
//           the full steps that tests/reference/solvers/newton/solver.cpp requires.
//   pinned  the truncated solution with springs on cut vertices, of stiffness (‖δ_v‖/‖δ'_v‖ − 1)(m_v/h² + earlier
//           stiffness). If two near vertices move together, truncation also shrinks the difference of their steps. With
//           the springs, free vertices react to the held ones, and a vertex with only inertia moves exactly to the
//           limit of its ball. Rounds are repeated while they lower the energy more. If all vertices were cut, `scaled`
//           does the same.
//
// If the line search accepts less than 10⁻³ of a step, contacts are detected for new balls.
//
// Balls and half-spaces do not move. So vertices that move together, or along each other, need one detection for each
// gap width of their path. With `newton_truncation=pair`, planes that move with near pairs separate them
// (moving_planes.hpp), and δ' is δ with the sides of these pairs moved apart. The guess loop still uses balls; a step
// ends with a detection at the stored positions.
//
// The Hessians of stencils are projected if the matrix is not positive definite without projection. They are also
// projected after an iteration that was cut, because far from the solution the matrix is rarely definite. If every
// iteration projected, a step of a crumpled cloth would end in many iterations of linear convergence: the projection
// keeps curvature that other stencils cancel.
//
// NewtonSteps::whole leaves all of this out: each iteration detects, solves and takes the whole step, even if the
// energy rises or surfaces intersect. A step ends at the tolerance or with its last iteration. This is the usual solve
// of a penalty method, a baseline.
//
// OGC's force jumps if a contact point leaves its block for a block that is not in contact (Fig. 22). So there may be
// no state whose force vanishes with the contacts detected there. Solves then alternate between two sets of contacts,
// or stop at a kink of one set (nearly parallel crossing strands jump between pairs of closest points). After a few
// such rounds that do not halve the residual, the step ends above the tolerance. steps.csv has the residual with the
// contacts at the step's end.
#pragma once

#include <functional>
#include <optional>

#include "reference/solvers/contact_step.hpp"
#include "reference/solvers/newton/factor.hpp"
#include "reference/solvers/newton/line_search.hpp"
#include "reference/solvers/newton/moving_planes.hpp"
#include "reference/solvers/newton/settings.hpp"

namespace ogc::reference {

/// Selects how Newton's method uses its direction.
enum class NewtonSteps {
  searched,  ///< truncates the direction and searches along it
  whole      ///< takes the whole direction: a baseline without bounds
};

/// Newton-OGC (method.md §7.6).
class NewtonSolver : public StepSolver, private ContactStep {
 public:
  /// Takes a rounded and valid scene; scene and topology must outlive the solver.
  NewtonSolver(const compare::Scene& scene, const compare::Topology& topology,
               const compare::SimulationOptions& options, NewtonSteps steps = NewtonSteps::searched);

  StepResult step(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
                  std::int64_t number) override;
  void set_orientations(std::span<const compare::Quaternion> orientations) override;
  std::vector<compare::Quaternion> orientations() const override;
  std::vector<std::string> stage_names() const override;

  /// Called for each accepted step of the line search, with the energy before the step, the change of the energy, and
  /// the rounding noise of energies [J]. Contacts and friction are constant during the step.
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
    State delta;         ///< δ of all vertices [m], then ω of all segments [1]; 0 if not free
    State truncated;     ///< δ'
    double largest = 0;  ///< largest ‖δ_v‖ of vertices and l ‖ω‖ of segments [m]
    std::size_t cut = 0;
  };

  std::uint32_t status_of(Outcome outcome) const;
  Outcome solve();
  Outcome solve_once();
  /// Runs one round of the loop; returns empty if the solve continues.
  std::optional<Outcome> iterate();
  std::optional<Outcome> advance(std::size_t prescribed_cut);
  bool judged_in_vain(double force);
  double mean_force() const;
  bool has_small_torque();
  /// Returns x, followed by ω = 0 for each segment of a rod.
  State unknowns() const;
  void derive(HessianProjection projection);
  /// Factorises the matrix; uses projected stencils if the matrix is not positive definite without them.
  bool factorized_definite();
  bool factorized();
  /// Fills three condition numbers: of the factorised matrix, of the matrix without friction, and of the matrix without
  /// friction and contact.
  void measure_condition(compare::IterationMetrics& row);
  void detect_with_planes();
  /// Moves prescribed vertices towards their targets as far as planes allow; returns the number of lagging vertices.
  std::size_t move_prescribed_between_planes();
  std::uint32_t end_between_planes(std::uint32_t status);
  Direction direction_of();
  void truncate(Direction& direction) const;
  /// Returns the largest share of δ that stays inside the regions or planes, the same for all vertices.
  double room_for(const State& delta) const;
  bool pin(const Direction& direction, std::vector<double>& pins);
  Accepted pinned(Direction direction, const PotentialTerms& before, double noise);
  /// Moves x along the best direction; returns the accepted share of the direction, or 0.
  double accepted_share(const Direction& direction);
  /// Takes the whole direction; returns 1.
  double whole_step(const Direction& direction);
  void move_to(State all);
  Accepted searched(const Direction& direction, const PotentialTerms& before, double noise) const;

  NewtonSettings newton_;
  NewtonSteps steps_;
  MovingPlanes planes_;  ///< of the last detection, with newton_truncation=pair
  BlockMatrix matrix_;
  Factor factor_;
  PotentialDerivatives derivatives_;  ///< of the last iteration
  /// whether the next detection (`judge_next_`) or the last one (`judging_`) judges a solve that converged or stalled
  /// with older contacts
  bool judge_next_ = false, judging_ = false;
  HessianProjection projection_ = HessianProjection::none;  ///< projection with which derivatives_ were computed
  int judgements_ = 0;                                      ///< number of judgements that did not halve the force
  double least_judged_ = 0;                                 ///< least force of all judgements [N]
  double reference_torque_ = -1;  ///< Σ ‖∂E/∂ω‖ after the guess [N m]; negative if not yet known
  bool pattern_stale_ = true;
};

}  // namespace ogc::reference
