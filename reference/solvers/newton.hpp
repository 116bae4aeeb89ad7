// Newton-OGC as a resident simulation.
#pragma once

#include <memory>

#include "compare/problem/contestant.hpp"

namespace ogc::reference {

/// The scene is rounded here; it must be valid. A step that fails (StepMetrics::status) is not committed: the snapshot stays that of the step before.
std::unique_ptr<compare::Simulation> start_newton(const compare::Scene& scene, const compare::SimulationOptions& options);

}  // namespace ogc::reference
