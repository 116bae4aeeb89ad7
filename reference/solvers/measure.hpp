// Computes targets before a step's solve, and velocities and metrics after it. Only the targets influence the
// iterations.
#pragma once

#include "compare/contestant.hpp"
#include "reference/solvers/detection.hpp"

namespace ogc::reference {

/// x, xᵗ and y of a step [m].
struct StepStates {
  const State& x;
  const State& start;
  const State& target;
};

/// Returns the target of each vertex [m]: y = xᵗ + h vᵗ + h² a if free, the motion at `time` [s] if prescribed, xᵗ if
/// fixed.
State inertial_targets(const compare::Scene& scene, const std::vector<compare::Vec3f>& start,
                       const std::vector<compare::Vec3f>& velocity, const std::vector<Mobility>& mobility, double time);

/// Returns (x − xᵗ)/h from the stored positions, rounded [m/s].
std::vector<compare::Vec3f> end_velocities(const std::vector<compare::Vec3f>& position, const State& start,
                                           double step);

/// Returns ‖Σ m (x − y)‖ / ‖Σ m (y − xᵗ)‖ over free vertices; 0 where nothing moves (method.md §5.3).
double momentum_lost(const StepStates& states, const Potential& potential);
/// Returns √(Σ m ‖x − before‖²) / √(Σ m ‖x − xᵗ‖²) over free vertices; 0 if nothing moves (method.md §6). `before` is x
/// before the last sweep or iteration; if it is empty, the result is not-a-number.
double last_motion(const StepStates& states, const State& before, const Potential& potential);
/// Returns the largest distance of a prescribed vertex from its target [m].
double largest_lag(const State& x, const State& target, const std::vector<Mobility>& mobility);
/// Fills the energies; sets them to not-a-number if `wanted` is false.
void measure_energies(compare::StepMetrics& metrics, const StepStates& states, const Potential& potential,
                      const compare::Scene& scene, bool wanted);
/// Checks whether all vertices keep their bounds (method.md §5.5, §5.6). ‖x − X_prev‖ ≤ b_v is checked in double
/// precision, the half-spaces exactly.
bool keeps_bounds(const std::vector<compare::Vec3f>& position, const Detected& detected);

}  // namespace ogc::reference
