// The stages instantiated for the host's threads.
#include <string>
#include <utility>

#include <tbb/info.h>

#include "fast/cpu/backend.hpp"
#include "fast/cpu/cpu.hpp"
#include "fast/cpu/simulation.hpp"
#include "fast/probes/probes.hpp"

namespace ogc::fast {

BackendInfo cpu_info() { return {true, true, std::to_string(tbb::info::default_concurrency()) + " threads"}; }

compare::Contestant cpu_contestant() {
  compare::Contestant contestant = probe_contestant("cpu", std::make_shared<CpuBackend>());
  contestant.start = [](const compare::Scene& scene, const compare::SimulationOptions& options) {
    return start_cpu(scene, options);
  };
  return contestant;
}

std::unique_ptr<ContactEngine> cpu_contact_engine(const compare::Topology& topology,
                                                  const compare::ExclusionView& exclusions) {
  static CpuBackend backend;
  return std::make_unique<BackendContactEngine<CpuBackend>>(backend, topology, exclusions);
}

}  // namespace ogc::fast
