// Instantiates the stages on the host.
#include "fast/cpu/simulation.hpp"

#include <string>

#include <tbb/task_arena.h>

#include "fast/cpu/backend.hpp"
#include "fast/stages/simulation.hpp"

namespace ogc::fast {

std::unique_ptr<compare::Simulation> start_cpu(const compare::Scene& scene, const compare::SimulationOptions& options,
                                               int list_capacity) {
  const int threads = tbb::this_task_arena::max_concurrency();
  const std::string device = std::to_string(threads) + (threads == 1 ? " thread" : " threads");
  return std::make_unique<ResidentSimulation<CpuBackend>>(CpuBackend{}, scene, options, device, list_capacity);
}

}  // namespace ogc::fast
