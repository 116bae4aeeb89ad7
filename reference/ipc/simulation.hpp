// Starts IPC as a simulation that keeps its state from step to step.
#pragma once

#include <memory>

#include "compare/contestant.hpp"

namespace ogc::reference {

/// Starts IPC. Rounds its copy of the scene, which must be valid. Starting and restoring a snapshot throw
/// compare::InputError with the pairs that intersect or touch. A step that fails (StepMetrics::status) is not
/// committed.
std::unique_ptr<compare::Simulation> start_ipc(const compare::Scene& scene, const compare::SimulationOptions& options);

}  // namespace ogc::reference
