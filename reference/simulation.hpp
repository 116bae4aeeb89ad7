// Resident simulations by the reference's solvers.
#pragma once

#include <memory>

#include "compare/contestant.hpp"

namespace ogc::reference {

/// Starts Newton-OGC (method.md §7.6). Rounds its copy of the scene, which must be valid. A step that fails
/// (StepMetrics::status) is not committed: the snapshot stays that of the step before.
std::unique_ptr<compare::Simulation> start_newton(const compare::Scene& scene,
                                                  const compare::SimulationOptions& options);

/// Starts Newton's method with whole steps on the energies of a penalty method: without bounds, line search or
/// guarantee. Throws compare::InputError where the scene's settings have bounds, or another activation than the
/// quadratic one.
std::unique_ptr<compare::Simulation> start_penalty(const compare::Scene& scene,
                                                   const compare::SimulationOptions& options);

/// Starts Vertex Block Descent in double, on a rounded copy of the scene, which must be valid. `colour`: as for
/// VbdSolver.
std::unique_ptr<compare::Simulation> start_vbd(const compare::Scene& scene, const compare::SimulationOptions& options,
                                               std::vector<compare::Index> colour = {});

}  // namespace ogc::reference
