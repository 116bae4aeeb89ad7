// IPC as a resident simulation.
#pragma once

#include <memory>

#include "compare/contestant.hpp"

namespace ogc::reference {

/// Starts IPC. Rounds its copy of the scene, which must be valid. Throws compare::InputError with the pairs that
/// intersect or touch at the start, here and where a snapshot is restored. A step that fails (StepMetrics::status) is
/// not committed.
std::unique_ptr<compare::Simulation> start_ipc(const compare::Scene& scene, const compare::SimulationOptions& options);

}  // namespace ogc::reference
