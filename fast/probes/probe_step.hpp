// Lets the judge test a step: a resident simulation of the scene takes one step, and a trace records it.
#pragma once

#include <utility>

#include "fast/probes/download.hpp"
#include "fast/probes/trace.hpp"
#include "fast/stages/simulation.hpp"

namespace ogc::fast {

/// Takes one step of a simulation and returns its events. If the step was repeated because a list grew, only the last
/// attempt is returned. The results of the step are the same as without a trace.
template <class Backend>
compare::StepOut trace_step(ResidentSimulation<Backend>& simulation) {
  StepState<Backend>& state = simulation.state();
  StepTrace<Backend> trace(simulation.backend(), simulation.step(), state, simulation.detection(), simulation.volumes(),
                           simulation.rods(), simulation.topology());
  compare::StepOut out;
  out.orientation_start = simulation.rods().start();
  simulation.observe(&trace);
  simulation.advance(1);
  simulation.observe(nullptr);
  const auto positions = [&](const auto& buffer) {
    return download_positions(simulation.backend(), buffer.data(), buffer.size());
  };
  out.colour = simulation.colouring().colour;
  out.rest = rest_state_out({&simulation.scene(), &simulation.topology()});
  out.query_radius = simulation.query_radius();
  out.events = trace.take();
  out.target = positions(state.target);
  out.position = positions(state.start);
  out.velocity = positions(state.velocity);
  out.segment_colour.assign(simulation.segment_colouring().colour.begin(), simulation.segment_colouring().colour.end());
  out.turned = trace.take_turned();
  out.orientation = simulation.rods().start();
  return out;
}

/// Answers the stage `step`. `list_capacity`: see ResidentSimulation.
template <class Backend>
compare::StepOut probe_step(const compare::StepIn& in, int list_capacity = 0, Backend backend = Backend{}) {
  compare::SimulationOptions options;
  options.energies = false;
  ResidentSimulation<Backend> simulation(std::move(backend), *in.scene, options, "probe", list_capacity);
  return trace_step(simulation);
}

}  // namespace ogc::fast
