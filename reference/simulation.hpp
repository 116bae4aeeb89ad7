// Starts simulations with the reference's solvers, which keep their state from step to step.
#pragma once

#include <memory>

#include "compare/contestant.hpp"

namespace ogc::reference {

/// Starts Newton-OGC (method.md §7.6). Rounds its copy of the scene, which must be valid. A step that fails
/// (StepMetrics::status) is not committed: the snapshot stays that of the previous step.
std::unique_ptr<compare::Simulation> start_newton(const compare::Scene& scene,
                                                  const compare::SimulationOptions& options);

/// Starts the penalty method: Newton's method with whole steps, without bounds, line search or guarantee. Throws
/// compare::InputError if the scene's settings have bounds, or an activation other than the quadratic one.
std::unique_ptr<compare::Simulation> start_penalty(const compare::Scene& scene,
                                                   const compare::SimulationOptions& options);

/// Starts Vertex Block Descent in double. Rounds its copy of the scene, which must be valid. `colour` holds the
/// vertices' colours; if it is empty, the solver computes them (VbdSolver).
std::unique_ptr<compare::Simulation> start_vbd(const compare::Scene& scene, const compare::SimulationOptions& options,
                                               std::vector<compare::Index> colour = {});

}  // namespace ogc::reference
