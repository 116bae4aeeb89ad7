// Declares the resident simulation on the host's threads.
#pragma once

#include <memory>

#include "compare/contestant.hpp"

namespace ogc::fast {

/// Starts a simulation of the scene. Throws compare::InputError if build_rest_state does (fast/stages/rest_state.hpp).
/// `list_capacity`: number of contacts for which the lists have room at first; 0: for those that a detection before
/// the first step finds. Lists grow by themselves; tests set a small capacity to make them grow.
std::unique_ptr<compare::Simulation> start_cpu(const compare::Scene& scene, const compare::SimulationOptions& options,
                                               int list_capacity = 0);

}  // namespace ogc::fast
