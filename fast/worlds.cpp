#include "fast/worlds.hpp"

#include "compare/problem/error.hpp"
#include "fast/cpu/cpu.hpp"
#if defined(OGC_HAS_CUDA)
#include "fast/cuda/cuda.hpp"
#endif

namespace ogc::fast {

std::size_t free_bytes(Backend backend) {
#if defined(OGC_HAS_CUDA)
  if (backend == Backend::cuda) return cuda_free_bytes();
#endif
  if (backend == Backend::cuda) throw compare::ResourceError("backend cuda: " + backend_info(backend).description);
  return cpu_bytes();
}

void expect_room(Backend backend, const compare::Scene& scene, std::size_t worlds) {
  const std::size_t each = world_bytes(scene), free = free_bytes(backend);
  if (worlds <= free / each) return;
  const auto mebibytes = [](double bytes) {
    return std::to_string(static_cast<std::int64_t>(bytes / (1 << 20))) + " MiB";
  };
  const bool is_device = backend == Backend::cuda;
  throw compare::ResourceError(
      std::to_string(worlds) + " worlds need " + mebibytes(static_cast<double>(worlds) * static_cast<double>(each)) +
      " of memory at their start, and " + (is_device ? "the device has " : "the machine has ") +
      mebibytes(static_cast<double>(free)) + (is_device ? " free" : "") + ": run at most " +
      std::to_string(free / each) + " worlds" +
      (is_device ? ", end other programs on the device, or run with the backend cpu" : ""));
}

std::unique_ptr<Worlds> start_worlds(Backend backend, std::span<const compare::Scene> scenes,
                                     const compare::SimulationOptions& options) {
  if (scenes.empty()) throw compare::InputError("worlds: give at least one scene");
  if (options.profile) throw compare::InputError("worlds have no times by stage; leave profile out");
  expect_room(backend, scenes.front(), scenes.size());
  if (backend == Backend::cpu) return start_cpu_worlds(scenes, options);
#if defined(OGC_HAS_CUDA)
  return start_cuda_worlds(scenes, options);
#else
  throw compare::ResourceError("backend cuda: " + backend_info(backend).description + ", or use the backend cpu");
#endif
}

}  // namespace ogc::fast
