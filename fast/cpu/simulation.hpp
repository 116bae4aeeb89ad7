// The resident simulation on the host's threads.
#pragma once

#include <memory>

#include "compare/contestant.hpp"

namespace ogc::fast {

/// A simulation of the scene, at its start. Throws compare::InputError for a scene without energies for what moves
/// (fast/stages/rest_state.hpp). `list_capacity`: contacts that fit at first; 0 for a guess by mesh size. Lists grow by
/// themselves; the setting serves tests of that.
std::unique_ptr<compare::Simulation> start_cpu(const compare::Scene& scene, const compare::SimulationOptions& options,
                                               int list_capacity = 0);

}  // namespace ogc::fast
