// Newton-OGC: Algorithm 3 with Newton's method for its solve. A step is
//
//   detect at xᵗ ── guess loop (Eq. 28, method.md §5) ── friction lagged ── detect ──┐
//                        ┌───────────────────────────────────────────────────────────┘
//                        ▼
//     prescribed vertices to their targets, truncated ── gradient, Hessian ── residual ≤ tolerance? ── solve ── truncate δ ── backtrack (method.md §7)
//                        ▲                                                                                          │
//                        └─────────────── detect again when vertices were cut, or to judge the residual ──────┘
//
// Choices that the paper leaves open. Friction of the first solve is lagged to xᵗ, where contact forces are those of a converged step; after the guess loop
// they are not. Contacts are detected once more after the guess loop: the reference residual f* of Eq. 29 asks for them, and the solve begins with full balls.
// A solve to a tolerance detects again as soon as one vertex was cut, as method.md §6 asks of all that is run to convergence: a vertex that its ball holds back
// would keep the residual up for good. Without a tolerance γ_e decides alone. The solve takes prescribed vertices as they are and never waits for them: where
// bounds keep one from its target it lags, as in the fast path.
//
// OGC's force jumps where a contact point leaves its block for one that is not in contact (Fig. 22), so that there may be no state at all whose force vanishes
// with the contacts detected at it: solves then alternate between two sets of contacts, each converged with its own. After a few of these rounds the step ends,
// with the residual of the contacts at its end, above the tolerance: steps.csv shows it.
#pragma once

#include <functional>
#include <optional>

#include "compare/problem/contestant.hpp"
#include "reference/solvers/newton_detection.hpp"
#include "reference/solvers/newton_factor.hpp"

namespace ogc::reference {

/// Where the time of a step goes.
enum class NewtonStage : std::uint8_t { detection, derivatives, assembly, factorization, line_search };
inline constexpr std::size_t newton_stage_count = 5;
std::vector<std::string> newton_stage_names();

/// What a step came to. Positions are those to store, rounded; of a step that failed they must not be used.
struct NewtonStep {
  std::vector<compare::Vec3f> position, velocity;  ///< [m], [m/s]
  compare::StepMetrics metrics;
  Detected detected;                               ///< the last detection
  float query_radius = 0;                          ///< [m]
};

class NewtonSolver {
 public:
  /// Scene: rounded and valid. Both must outlive it.
  NewtonSolver(const compare::Scene& scene, const compare::Topology& topology, const compare::SimulationOptions& options);

  /// The step with this number, from 1. Throws compare::ResourceError where memory runs out.
  NewtonStep step(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity, std::int64_t number);

  /// Called with each accepted step of the line search: energies before and after, with the same contacts and friction [J].
  std::function<void(double before, double change, double noise)> on_accepted;

 private:
  enum class Outcome { converged, iteration_limit, indefinite, no_decrease, not_finite };
  struct Direction {
    State delta;               ///< of all vertices; 0 where not free [m]
    State truncated;           ///< δ'
    double largest = 0;        ///< ‖δ‖_∞ [m]
    std::size_t cut = 0;
  };

  void begin(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity, std::int64_t number);
  void detect_here();
  void guess();
  bool many(std::size_t cut) const;
  bool nothing_near() const;  ///< the contacts at x are none, without asking
  std::size_t move_prescribed();
  Outcome solve();
  Outcome solve_once();
  /// One round of the loop; empty where it goes on.
  std::optional<Outcome> iterate();
  std::optional<Outcome> advance(const PotentialDerivatives& derivatives, std::size_t prescribed_cut);
  double mean_force(const PotentialDerivatives& derivatives) const;
  compare::IterationMetrics new_row(bool detects) const;
  bool factorized(const PotentialDerivatives& derivatives);
  Direction direction_of(const PotentialDerivatives& derivatives);
  double searched(const Direction& direction, const PotentialDerivatives& derivatives);
  double backtracked(const State& delta, double share, const PotentialTerms& before, double noise);
  void finish(NewtonStep& step, Outcome outcome);

  template <class Work>
  auto timed(NewtonStage stage, Work work);

  const compare::Scene& scene_;
  const compare::Topology& topology_;
  const compare::Settings& settings_;
  compare::SimulationOptions options_;
  std::vector<compare::Index> groups_;
  Potential potential_;
  BlockMatrix matrix_;
  Factor factor_;
  std::vector<std::size_t> movable_;      ///< free and prescribed vertices: K of them

  State start_, target_, x_;
  Detected detected_;
  Balls balls_;
  float query_radius_ = 0;
  bool detect_next_ = false, fresh_ = false;  ///< contacts must be detected; they were detected at this very x
  bool judge_next_ = false, judging_ = false; ///< contacts are detected to judge a solve that has converged with those before
  int judgements_ = 0;
  bool pattern_stale_ = true;
  std::size_t cut_ = 0;                       ///< in the last iteration, prescribed vertices included
  std::int64_t iterations_since_ = 0;         ///< since the last detection
  double reference_force_ = -1;               ///< mean ‖f*‖ [N]; negative before it is known
  double residual_ = 0;
  double started_ms_ = 0;
  compare::StepMetrics metrics_;
  std::vector<compare::IterationMetrics> rows_;
  std::array<double, newton_stage_count> stage_ms_{};
};

}  // namespace ogc::reference
