// What Newton's method and VBD share of a step (Algorithm 3, method.md §5.2): targets, detections with their regions,
// the guess loop, prescribed vertices, the row at the end. How the free vertices move between two detections, each
// solver decides.
//
//   begin ── guess: detect, x ← y inside the regions, again while many are cut ──┐
//     ┌────────────────────────────────────────────────────────────────────────┘
//     the solver's iterations, with detect_here where detect_next_ says so ── finish
#pragma once

#include "compare/contestant.hpp"
#include "reference/definitions/scene_volumes.hpp"
#include "reference/solvers/feasible_regions.hpp"
#include "reference/solvers/variants/settings.hpp"

namespace ogc::reference {

/// What a step came to. Positions are those to store, rounded; of a step that failed they must not be used.
struct StepResult {
  std::vector<compare::Vec3f> position, velocity;  ///< [m], [m/s]
  std::vector<compare::Quaternion> orientation;    ///< of the segments of rods
  compare::StepMetrics metrics;
  Detected detected;       ///< the last detection
  float query_radius = 0;  ///< [m]
};

/// Whoever takes a scene from one step to the next.
class StepSolver {
 public:
  virtual ~StepSolver() = default;
  /// The step with this number, from 1. Throws compare::ResourceError where memory runs out.
  virtual StepResult step(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
                          std::int64_t number) = 0;
  /// qᵗ of the next step, of the segments of rods; those of the scene's start where there are none.
  virtual void set_orientations(std::span<const compare::Quaternion> orientations) = 0;
  /// q at the end of the last step.
  virtual std::vector<compare::Quaternion> orientations() const = 0;
  /// Of StepMetrics::stage_ms.
  virtual std::vector<std::string> stage_names() const = 0;
};

/// What ends the guess loop, besides few cut vertices and `guess_rounds`.
enum class GuessEnd {
  rounds,  ///< nothing else: contacts hold what would close them, and all else goes on (method.md §5.2)
  /// the first contact, if it is at xᵗ before the first round: none is passed by in part, so that nothing is distorted
  contact
};

/// The parts of a step, for solvers to derive from.
class ContactStep {
 public:
  ContactStep(const ContactStep&) = delete;
  ContactStep& operator=(const ContactStep&) = delete;

 protected:
  /// The first stage of every solver.
  static constexpr std::size_t detection_stage = 0;

  /// Scene: rounded and valid. Both must outlive it.
  ContactStep(const compare::Scene& scene, const compare::Topology& topology, const compare::SimulationOptions& options,
              std::size_t stages);
  ~ContactStep() = default;

  void begin(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
             std::int64_t number);
  void detect_here();
  /// Friction is lagged to xᵗ in it, where contact forces are those of a converged step.
  void guess(GuessEnd end);
  bool in_contact() const;  ///< at the last detection
  /// Whether vertices that were cut ask for a detection: `times` γ_e K of them, at least one; with planes so many free
  /// ones, or a prescribed one behind its target, alone if the last detection let it advance, otherwise once a step.
  bool asks(std::size_t cut, std::int64_t times = 1);
  bool nothing_near() const;  ///< the contacts at x are none, without asking
  std::size_t move_prescribed();
  /// Where `settings` ask for a detection after an iteration that cut so many vertices.
  bool detection_due(std::size_t cut);
  void set_residual(double mean_force);  ///< Eq. 29; the first one of a step is f*
  compare::IterationMetrics new_row(bool detects) const;
  StepResult finish(std::uint32_t status);
  double elapsed_ms() const;  ///< since the step began

  template <class Work>
  auto timed(std::size_t stage, Work work) {
    struct Clock {
      double& sum;
      double start = now_ms();
      ~Clock() { sum += now_ms() - start; }
    } clock{stage_ms_[stage]};
    return work();
  }

  const compare::Scene& scene_;
  const compare::Topology& topology_;
  const compare::Settings& settings_;
  compare::SimulationOptions options_;
  compare::Exclusions exclusions_;
  Potential potential_;
  SceneVolumes volumes_;
  std::vector<std::size_t> movable_;  ///< free vertices, and prescribed ones of surfaces
  std::vector<std::size_t> driven_;   ///< prescribed vertices of volumes
  std::size_t bounded_ = 0;           ///< K, those of them that have a bound

  State start_, target_, x_;
  State before_;  ///< x before the last iteration; empty: there was none
  Detected detected_;
  FeasibleRegions regions_;
  float query_radius_ = 0;
  bool detect_next_ = false, fresh_ = false;  ///< contacts must be detected; they were detected at this very x
  std::size_t cut_ = 0;                       ///< in the last iteration, prescribed vertices included
  std::int64_t iterations_since_ = 0;         ///< since the last detection
  double reference_force_ = -1;               ///< mean ‖f*‖ [N]; negative before it is known
  double residual_ = 0;
  compare::StepMetrics metrics_;
  std::vector<compare::IterationMetrics> rows_;

 private:
  static double now_ms();

  /// What divides gaps at `here` with bounds=dat; else empty.
  std::vector<compare::Vec3f> displacements_at(const std::vector<compare::Vec3f>& here) const;
  /// In place of the method's contacts, where `contact_set` names others.
  void replace_contacts();
  bool many(std::size_t cut, std::int64_t times) const;
  void move_towards(const Triple<double>& proposal, std::size_t vertex, std::size_t& cut);

  ContactSet contact_set_;
  /// Prescribed vertices behind their targets, since the last question; whether one has moved since the last
  /// detection; whether one has asked in this step.
  std::size_t lagging_ = 0;
  bool advanced_ = false, lag_asked_ = false;
  bool guessing_ = false;  ///< in the guess loop
  double started_ms_ = 0;
  std::vector<double> stage_ms_;
};

}  // namespace ogc::reference
