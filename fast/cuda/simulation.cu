// Instantiates the resident simulation on the device.
#include "fast/stages/simulation.hpp"

#include "fast/cuda/backend.cuh"
#include "fast/cuda/cuda.hpp"

namespace ogc::fast {

std::unique_ptr<compare::Simulation> start_cuda(const compare::Scene& scene, const compare::SimulationOptions& options,
                                                int list_capacity) {
  return std::make_unique<ResidentSimulation<CudaBackend>>(CudaBackend{}, scene, options, cuda_info().description,
                                                           list_capacity);
}

}  // namespace ogc::fast
