// The parts of a step (Algorithm 3, method.md §5.2) that Newton's method and VBD share: targets, detections with their
// regions, the guess loop, prescribed vertices, the row of the step. Each solver has its own iterations between two
// detections. The order of calls:
//
//   begin    sets xᵗ and the targets y
//   guess    repeats: detect at x, move x towards y inside the regions; until few vertices are cut
//   loop of the solver: detect_here if detect_next_ is set, then one iteration
//   finish   returns the result
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
  /// Sets qᵗ of the rods' segments for the next step. An empty span selects the orientations at the scene's start.
  virtual void set_orientations(std::span<const compare::Quaternion> orientations) = 0;
  /// Returns q at the end of the last step.
  virtual std::vector<compare::Quaternion> orientations() const = 0;
  /// Returns the names of the stages in the order of StepMetrics::stage_ms.
  virtual std::vector<std::string> stage_names() const = 0;
};

/// Selects a condition that ends the guess loop early. Without it, the loop ends if few vertices are cut, or after
/// `guess_rounds`.
enum class GuessEnd {
  rounds,  ///< no early end: a vertex that meets a contact stops, all others move on (method.md §5.2)
  /// the loop ends at the first contact, and no round runs if there are contacts at xᵗ. A further round would move only
  /// vertices without contact and distort the mesh
  contact
};

/// Base class of solvers with the shared parts of a step.
class ContactStep {
 public:
  ContactStep(const ContactStep&) = delete;
  ContactStep& operator=(const ContactStep&) = delete;

 protected:
  /// Index of the detection stage, which is the first stage of every solver.
  static constexpr std::size_t detection_stage = 0;

  /// Takes a rounded and valid scene. Scene and topology must outlive this object.
  ContactStep(const compare::Scene& scene, const compare::Topology& topology, const compare::SimulationOptions& options,
              std::size_t stages);
  ~ContactStep() = default;

  void begin(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
             std::int64_t number);
  void detect_here();
  /// Runs the guess loop. Friction is lagged to xᵗ, because the contact forces there are those of a converged step.
  void guess(GuessEnd end);
  bool in_contact() const;  ///< whether the last detection found contacts
  /// Returns whether `cut` cut vertices trigger a detection: at least `times` γ_e K of them, and at least one. With
  /// bounds=planes, prescribed vertices behind their targets are counted separately. They trigger a detection if one of
  /// them has moved since the last detection, or if they have triggered none in this step.
  bool asks(std::size_t cut, std::int64_t times = 1);
  bool nothing_near() const;  ///< whether x certainly has no contacts, without a detection
  std::size_t move_prescribed();
  /// Returns whether a detection is due after an iteration that cut `cut` vertices: if `detection_gap` iterations have
  /// passed and `asks` returns true, or by the setting `detection_every`.
  bool detection_due(std::size_t cut);
  /// Returns whether any of `cut` vertices is not a prescribed one behind its target. `asks` forgets which are.
  bool is_any_cut(std::size_t cut) const { return cut > lagging_; }
  /// Returns whether fewer than `detection_gap` iterations have passed since the last detection.
  bool waits() const { return iterations_since_ < settings_.detection_gap; }
  void set_residual(double mean_force);  ///< sets the residual of Eq. 29; the first force of a step is f*
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
  /// `detect_next_`: whether contacts must be detected. `fresh_`: whether they were detected at the present x
  bool detect_next_ = false, fresh_ = false;
  std::size_t cut_ = 0;                ///< vertices cut in the last iteration, prescribed ones included
  std::int64_t iterations_since_ = 0;  ///< iterations since the last detection
  double reference_force_ = -1;        ///< mean ‖f*‖ [N]; negative if not yet known
  double residual_ = 0;
  compare::StepMetrics metrics_;
  std::vector<compare::IterationMetrics> rows_;

 private:
  static double now_ms();

  /// Returns the displacements that bounds=dat (planes of *Divide and Truncate*) needs: it divides the gap of a pair in
  /// proportion to the displacements of both sides. Empty for other bounds.
  std::vector<compare::Vec3f> displacements_at(const std::vector<compare::Vec3f>& here) const;
  /// Replaces the detected contacts by the set that the setting `reference_contact_set` selects.
  void replace_contacts();
  bool many(std::size_t cut, std::int64_t times) const;
  void move_towards(const Triple<double>& proposal, std::size_t vertex, std::size_t& cut);

  ContactSet contact_set_;
  /// State of `asks`: the number of prescribed vertices behind their targets since its last call, whether one of them
  /// has moved since the last detection, and whether one has triggered a detection in this step.
  std::size_t lagging_ = 0;
  bool advanced_ = false, lag_asked_ = false;
  bool guessing_ = false;  ///< whether the guess loop runs
  double started_ms_ = 0;
  std::vector<double> stage_ms_;
};

}  // namespace ogc::reference
