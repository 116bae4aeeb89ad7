// The stages instantiated for the device, for the judge.
#include "fast/probes/probes.hpp"

#include <memory>

#include "fast/cuda/backend.cuh"
#include "fast/cuda/cuda.hpp"

namespace ogc::fast {

compare::Contestant cuda_contestant(const LaunchShape& shape) {
  compare::Contestant contestant = probe_contestant("cuda", std::make_shared<CudaBackend>(shape),
                                                    [shape] { return CudaBackend(shape); });
  contestant.start = [](const compare::Scene& scene, const compare::SimulationOptions& options) {
    return start_cuda(scene, options);
  };
  return contestant;
}

}  // namespace ogc::fast
