// Computes the share of a step's momentum that its guess loop lost (method.md §5.3), for steps whose start is known.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "compare/contestant.hpp"

namespace ogc::experiments {

/// Makes a step's loss meaningful. A row's loss is relative to ‖Σ m (y − xᵗ)‖, which means nothing where directions
/// cancel; this class remembers starts of steps and converts the loss to one relative to Σ m ‖y − xᵗ‖.
class MomentumShare {
 public:
  /// Takes a valid scene, which need not outlive this object.
  explicit MomentumShare(const compare::Scene& scene);
  /// Remembers that the step after `step` begins with these velocities [m/s].
  void begin_after(std::int64_t step, const std::vector<compare::Vec3f>& velocities);
  /// Returns ‖Σ m (x − y)‖ / Σ m ‖y − xᵗ‖ after the guess loop; it is at most 1 unless moving partners carry vertices
  /// along. Empty if the start of the row's step is not known, or if its guess loop did not do all rounds: then
  /// contacts ended it, and give back what it lost.
  std::optional<double> lost(const compare::StepMetrics& row) const;

 private:
  std::vector<double> mass_;  ///< mass by vertex [kg]; 0 if it is not free
  compare::Vec3 fall_;        ///< h² a [m]
  double step_;               ///< h [s]
  std::int64_t guess_rounds_;
  std::map<std::int64_t, double> net_;  ///< ‖Σ m (y − xᵗ)‖ / Σ m ‖y − xᵗ‖ by step
};

}  // namespace ogc::experiments
