// The reference's own Vertex Block Descent: Algorithms 3 and 4 in double, for whole runs. Colours one after the other,
// vertices of a colour in parallel, read as method.md §7.2 says; each new position is cut to its ball before it is
// written. Positions are doubles within a step and rounded at its end, as Newton's.
//
// Residuals are measurements beside the run, and their time no part of the step's: those of the rows with the contacts
// of the last detection, that of the step with contacts detected at its end.
#pragma once

#include "reference/solvers/contact_step.hpp"
#include "reference/solvers/residual.hpp"
#include "reference/solvers/vertex_system.hpp"

namespace ogc::reference {

/// Vertex Block Descent in double (Alg. 3 and 4).
class VbdSolver : public StepSolver, private ContactStep {
 public:
  /// Scene: rounded and valid. Both must outlive it. `colour`: by vertex, from 0 on where free, −1 elsewhere; no two
  /// vertices of a membrane, hinge or spring may share one. Empty: colours of its own (colouring.hpp). Throws
  /// std::invalid_argument where they do not fit the scene. The settings of variants/settings.hpp are read.
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
  std::size_t cut_all(const State& old);  ///< free vertices to their bounds
  bool is_deep_inside() const;  ///< whether a vertex is, by what the last detection froze
  /// Work that needs the meter and costs the step no time; none without one.
  template <class Work>
  void measured(Work work);
  void add_row(bool detects);
  bool finite() const;

  CutAfter cut_after_;
  VertexSystems systems_;
  std::vector<compare::Index> colour_;
  std::vector<std::vector<compare::Index>> classes_;  ///< vertices by colour
  std::optional<ResidualMeter> meter_;
  std::vector<compare::Quaternion> orientations_;  ///< qᵗ, where it is measured
  double measuring_ms_ = 0;
};

}  // namespace ogc::reference
