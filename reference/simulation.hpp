// The reference's solvers as resident simulations.
#pragma once

#include <memory>

#include "compare/contestant.hpp"

namespace ogc::reference {

/// Newton-OGC (method.md §7.6). The scene is rounded here; it must be valid. A step that fails (StepMetrics::status) is
/// not committed: the snapshot stays that of the step before.
std::unique_ptr<compare::Simulation> start_newton(const compare::Scene& scene,
                                                  const compare::SimulationOptions& options);

/// Newton's method with whole steps on the energies of a penalty method: no bound, no line search, no guarantee. Throws
/// compare::InputError where the scene's settings have bounds, or another activation than the quadratic one.
std::unique_ptr<compare::Simulation> start_penalty(const compare::Scene& scene,
                                                   const compare::SimulationOptions& options);

/// Vertex Block Descent in double, likewise. `colour` as for VbdSolver.
std::unique_ptr<compare::Simulation> start_vbd(const compare::Scene& scene, const compare::SimulationOptions& options,
                                               std::vector<compare::Index> colour = {});

}  // namespace ogc::reference
