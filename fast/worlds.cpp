#include "fast/worlds.hpp"

#include "compare/problem/error.hpp"
#include "fast/cpu/cpu.hpp"
#if defined(OGC_HAS_CUDA)
#include "fast/cuda/cuda.hpp"
#endif

namespace ogc::fast {

std::unique_ptr<Worlds> start_worlds(Backend backend, std::span<const compare::Scene> scenes,
                                     const compare::SimulationOptions& options) {
  if (options.profile) throw compare::InputError("worlds have no times by stage; leave profile out");
  if (backend == Backend::cpu) return start_cpu_worlds(scenes, options);
#if defined(OGC_HAS_CUDA)
  return start_cuda_worlds(scenes, options);
#else
  throw compare::ResourceError("backend cuda: " + backend_info(backend).description + ", or use --backend cpu");
#endif
}

}  // namespace ogc::fast
