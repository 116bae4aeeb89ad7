// The reference's Vertex Block Descent: Algorithms 3 and 4 in double, for whole runs. Colours are solved one after the
// other, vertices of one colour in parallel. method.md §7.2 defines which positions an update reads. Each new position
// is truncated to its bound before it is written. Positions are doubles within a step and rounded at its end, as in
// Newton's method.
//
// The time of measuring residuals does not count as time of the step. A row of iterations.csv has the residual with the
// contacts of the last detection; a row of steps.csv has the residual with contacts detected at the step's end.
#pragma once

#include "reference/solvers/contact_step.hpp"
#include "reference/solvers/residual.hpp"
#include "reference/solvers/vertex_system.hpp"

namespace ogc::reference {

/// Vertex Block Descent in double (Alg. 3 and 4).
class VbdSolver : public StepSolver, private ContactStep {
 public:
  /// Takes a rounded and valid scene; scene and topology must outlive the solver. Reads the settings of
  /// variants/settings.hpp. `colour` holds a number from 0 on for each free vertex, −1 for all others. Two vertices of
  /// one element must have different colours. If `colour` is empty, the solver colours the vertices (colouring.hpp).
  /// Throws std::invalid_argument if the colours do not fit the scene.
  VbdSolver(const compare::Scene& scene, const compare::Topology& topology, const compare::SimulationOptions& options,
            std::vector<compare::Index> colour = {});

  StepResult step(const std::vector<compare::Vec3f>& start, const std::vector<compare::Vec3f>& velocity,
                  std::int64_t number) override;
  void set_orientations(std::span<const compare::Quaternion> orientations) override;
  std::vector<compare::Quaternion> orientations() const override;
  std::vector<std::string> stage_names() const override;

 private:
  enum Stage : std::size_t { detection = detection_stage, sweeping, stage_count };
  void iterate();
  std::size_t sweep();
  double largest_move() const;            ///< largest move of the last iteration along an axis [m]
  std::size_t cut_all(const State& old);  ///< cuts free vertices to their bounds
  /// Returns whether a vertex is deep inside a volume; depths come from the contacts of the last detection, with frozen
  /// n and weights.
  bool is_deep_inside() const;
  /// Calls `work`, which uses the residual meter, without adding its time to the step's. Does nothing if there is no
  /// meter.
  template <class Work>
  void measured(Work work);
  void add_row(bool detects);
  bool finite() const;

  CutAfter cut_after_;
  VertexSystems systems_;
  std::vector<compare::Index> colour_;
  std::vector<std::vector<compare::Index>> classes_;  ///< vertices by colour
  bool is_settled_ = false;  ///< whether the last iteration ends the step before its time (`settled_move`)
  std::optional<ResidualMeter> meter_;
  std::vector<compare::Quaternion> orientations_;  ///< qᵗ, kept if residuals are measured
  double measuring_ms_ = 0;
};

}  // namespace ogc::reference
