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

/// Starts a simulation that several parts divide, each with a thread of its own. It is no faster; it shows that parts
/// compute the bits of a whole. Throws as start_cpu does, and compare::InputError for a scene that cannot be divided.
std::unique_ptr<compare::Simulation> start_cpu_parts(const compare::Scene& scene,
                                                     const compare::SimulationOptions& options, int parts,
                                                     int list_capacity = 0);

}  // namespace ogc::fast
