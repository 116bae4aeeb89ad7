// What share of the momentum that a step is to have its guess loop lost (method.md §5.3), where the start is known.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "compare/contestant.hpp"

namespace ogc::experiments {

/// Remembers of the states that it is shown what the next step is to move, so that its row's loss, which is relative to
/// ‖Σ m (y − xᵗ)‖ and means nothing where directions cancel, becomes one relative to Σ m ‖y − xᵗ‖.
class MomentumShare {
 public:
  /// Of a valid scene, which need not outlive it.
  explicit MomentumShare(const compare::Scene& scene);
  /// The step after `step` begins with these velocities [m/s].
  void begin_after(std::int64_t step, const std::vector<compare::Vec3f>& velocities);
  /// ‖Σ m (x − y)‖ / Σ m ‖y − xᵗ‖ after the guess loop, at most 1 but for what moving partners carry along, where the
  /// row's step is known and did all its rounds. Contacts ended the other guess loops, and give back what these lost.
  std::optional<double> lost(const compare::StepMetrics& row) const;

 private:
  std::vector<double> mass_;  ///< by vertex [kg]; 0 where it is not free
  compare::Vec3 fall_;        ///< h² a [m]
  double step_;               ///< h [s]
  std::int64_t guess_rounds_;
  std::map<std::int64_t, double> net_;  ///< ‖Σ m (y − xᵗ)‖ / Σ m ‖y − xᵗ‖ by step
};

}  // namespace ogc::experiments
