// Computes the share of a step's momentum that its guess loop lost (method.md §5.3), for steps with a known start.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "compare/contestant.hpp"

namespace ogc::experiments {

/// Rescales the loss of momentum in a step's row. The row's loss is relative to ‖Σ m (y − xᵗ)‖, which vanishes if
/// vertices move against each other. This class remembers the starts of steps and returns the loss relative to Σ m ‖y −
/// xᵗ‖.
class MomentumShare {
 public:
  /// Takes a valid scene, which need not outlive this object.
  explicit MomentumShare(const compare::Scene& scene);
  /// Remembers that the step after `step` begins with these velocities [m/s].
  void begin_after(std::int64_t step, const std::vector<compare::Vec3f>& velocities);
  /// Returns ‖Σ m (x − y)‖ / Σ m ‖y − xᵗ‖ after the guess loop. It is at most 1 unless moving bodies drag vertices
  /// along. Empty if the start of the row's step is not known. Also empty if the guess loop did fewer rounds than
  /// allowed, because then contacts, not bounds, shortened the moves (method.md §5.3).
  std::optional<double> lost(const compare::StepMetrics& row) const;

 private:
  std::vector<double> mass_;  ///< by vertex [kg]; 0 if the vertex is not free
  compare::Vec3 fall_;        ///< h² times gravity [m]
  double step_;               ///< h [s]
  std::int64_t guess_rounds_;
  std::map<std::int64_t, double> net_;  ///< ‖Σ m (y − xᵗ)‖ / Σ m ‖y − xᵗ‖ by step
};

}  // namespace ogc::experiments
