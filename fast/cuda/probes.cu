// The stages and the resident simulation instantiated for the device. They are one source because a trace runs the
// simulation's own kernels: in two, all of them would be compiled twice, which takes minutes.
#include "fast/probes/probes.hpp"

#include <memory>

#include "fast/cuda/backend.cuh"
#include "fast/cuda/cuda.hpp"
#include "fast/stages/simulation.hpp"

namespace ogc::fast {

compare::Contestant cuda_contestant(const LaunchShape& shape) {
  compare::Contestant contestant = probe_contestant("cuda", std::make_shared<CudaBackend>(shape),
                                                    [shape] { return CudaBackend(shape); });
  contestant.start = [](const compare::Scene& scene, const compare::SimulationOptions& options) {
    return start_cuda(scene, options);
  };
  return contestant;
}

std::unique_ptr<compare::Simulation> start_cuda(const compare::Scene& scene, const compare::SimulationOptions& options,
                                                int list_capacity) {
  return std::make_unique<ResidentSimulation<CudaBackend>>(CudaBackend{}, scene, options, cuda_info().description,
                                                           list_capacity);
}

}  // namespace ogc::fast
