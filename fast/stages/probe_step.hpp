// The judge's way in to a step: a resident simulation of the scene takes one, and tells.
#pragma once

#include <utility>

#include "fast/stages/simulation.hpp"

namespace ogc::fast {

/// `list_capacity` as in ResidentSimulation.
template <class Backend>
compare::StepOut probe_step(const compare::StepIn& in, int list_capacity = 0, Backend backend = Backend{}) {
  compare::SimulationOptions options;
  options.profile = true;
  options.energies = false;
  return ResidentSimulation<Backend>(std::move(backend), *in.scene, options, "probe", list_capacity).trace();
}

}  // namespace ogc::fast
