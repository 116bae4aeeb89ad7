// The parts of a step (Algorithm 3, method.md §5.2) that Newton's method and VBD share: targets, detections with their
// regions, the guess loop, prescribed vertices, the row of the step. Each solver moves the free vertices between two
// detections in its own way.
//
//   begin ── guess: detect, x ← y inside the regions, again while many are cut ──┐
//     ┌────────────────────────────────────────────────────────────────────────┘
//     the solver's iterations, with detect_here where detect_next_ is set ── finish
#pragma once

#include "compare/contestant.hpp"
#include "reference/definitions/scene_volumes.hpp"
#include "reference/solvers/feasible_regions.hpp"
#include "reference/solvers/variants/settings.hpp"

namespace ogc::reference {

/// The result of a step. Positions are rounded, as stored; those of a failed step must not be used.
struct StepResult {
  std::vector<compare::Vec3f> position, velocity;  ///< [m], [m/s]
  std::vector<compare::Quaternion> orientation;    ///< orientations of the rods' segments
  compare::StepMetrics metrics;
  Detected detected;       ///< the last detection
  float query_radius = 0;  ///< [m]
};

/// Advances a scene by steps.
class StepSolver {
 public:
  virtual ~StepSolver() = default;
  /// Computes the step with this number, from 1. Throws compare::ResourceError if memory runs out.
  virtual StepResult step(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
                          std::int64_t number) = 0;
  /// Sets qᵗ of the rods' segments for the next step; an empty span selects the orientations of the scene's start.
  virtual void set_orientations(std::span<const compare::Quaternion> orientations) = 0;
  /// Returns q at the end of the last step.
  virtual std::vector<compare::Quaternion> orientations() const = 0;
  /// Returns the names of the stages in the order of StepMetrics::stage_ms.
  virtual std::vector<std::string> stage_names() const = 0;
};

/// Selects what ends the guess loop, besides few cut vertices and `guess_rounds`.
enum class GuessEnd {
  rounds,  ///< nothing else; contacts stop the vertices that would close them, all others move on (method.md §5.2)
  /// the first contact; a contact at xᵗ means no round. Otherwise vertices in contact would stay while others move on,
  /// and the mesh would distort
  contact
};

/// The parts of a step, as a base class of solvers.
class ContactStep {
 public:
  ContactStep(const ContactStep&) = delete;
  ContactStep& operator=(const ContactStep&) = delete;

 protected:
  /// Number of the detection stage, which is the first stage of every solver.
  static constexpr std::size_t detection_stage = 0;

  /// The scene must be rounded and valid; scene and topology must outlive this.
  ContactStep(const compare::Scene& scene, const compare::Topology& topology, const compare::SimulationOptions& options,
              std::size_t stages);
  ~ContactStep() = default;

  void begin(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
             std::int64_t number);
  void detect_here();
  /// Runs the guess loop. Friction is lagged to xᵗ, where contact forces are those of a converged step.
  void guess(GuessEnd end);
  bool in_contact() const;  ///< whether the last detection found contacts
  /// Returns whether cut vertices trigger a detection: at least `times` γ_e K of them, and at least one. With planes,
  /// prescribed vertices behind their targets do not count. One of them alone triggers a detection if the last
  /// detection let it advance, otherwise once a step.
  bool asks(std::size_t cut, std::int64_t times = 1);
  bool nothing_near() const;  ///< whether x certainly has no contacts, without a detection
  std::size_t move_prescribed();
  /// Returns whether a detection is due after an iteration that cut `cut` vertices, by `asks` or by `detection_every`.
  bool detection_due(std::size_t cut);
  void set_residual(double mean_force);  ///< Eq. 29; the first force of a step is f*
  compare::IterationMetrics new_row(bool detects) const;
  StepResult finish(std::uint32_t status);
  double elapsed_ms() const;  ///< time since the step began

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
  std::vector<std::size_t> movable_;  ///< free vertices, and prescribed vertices of surfaces
  std::vector<std::size_t> driven_;   ///< prescribed vertices of volumes
  std::size_t bounded_ = 0;           ///< K, the number of vertices with a bound

  State start_, target_, x_;
  State before_;  ///< x before the last iteration; empty if the step had none
  Detected detected_;
  FeasibleRegions regions_;
  float query_radius_ = 0;
  bool detect_next_ = false, fresh_ = false;  ///< contacts must be detected; they were detected at the present x
  std::size_t cut_ = 0;                       ///< vertices cut in the last iteration, prescribed ones included
  std::int64_t iterations_since_ = 0;         ///< iterations since the last detection
  double reference_force_ = -1;               ///< mean ‖f*‖ [N]; negative if not yet known
  double residual_ = 0;
  compare::StepMetrics metrics_;
  std::vector<compare::IterationMetrics> rows_;

 private:
  static double now_ms();

  /// Returns the displacements by which bounds=dat divides gaps at `here`; empty for other bounds.
  std::vector<compare::Vec3f> displacements_at(const std::vector<compare::Vec3f>& here) const;
  /// Replaces the method's contacts by the set that `reference_contact_set` selects.
  void replace_contacts();
  bool many(std::size_t cut, std::int64_t times) const;
  void move_towards(const Triple<double>& proposal, std::size_t vertex, std::size_t& cut);

  ContactSet contact_set_;
  /// Number of prescribed vertices behind their targets since the last call of `asks`; whether one of them has moved
  /// since the last detection; whether a lag has triggered a detection in this step.
  std::size_t lagging_ = 0;
  bool advanced_ = false, lag_asked_ = false;
  bool guessing_ = false;  ///< whether the guess loop runs
  double started_ms_ = 0;
  std::vector<double> stage_ms_;
};

}  // namespace ogc::reference
