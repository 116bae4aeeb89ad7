// Makes contestants of the reference's solvers, which answer no stage.
#include "reference/contestant.hpp"

#include "reference/ipc/simulation.hpp"
#include "reference/simulation.hpp"

namespace ogc::reference {

compare::Contestant newton() {
  compare::Contestant contestant;
  contestant.name = "newton";
  contestant.start = start_newton;
  return contestant;
}

compare::Contestant penalty() {
  compare::Contestant contestant;
  contestant.name = "penalty";
  contestant.start = start_penalty;
  return contestant;
}

compare::Contestant ipc() {
  compare::Contestant contestant;
  contestant.name = "ipc";
  contestant.start = start_ipc;
  return contestant;
}

compare::Contestant vbd(std::function<std::vector<compare::Index>(const compare::Scene&)> colours) {
  compare::Contestant contestant;
  contestant.name = "reference_vbd";
  contestant.start = [colours = std::move(colours)](const compare::Scene& scene,
                                                    const compare::SimulationOptions& options) {
    return start_vbd(scene, options, colours ? colours(scene) : std::vector<compare::Index>{});
  };
  return contestant;
}

}  // namespace ogc::reference
