#include "fast/worlds.hpp"

#include <unistd.h>

#include "compare/problem/error.hpp"
#include "fast/cpu/cpu.hpp"
#if defined(OGC_HAS_CUDA)
#include "fast/cuda/cuda.hpp"
#endif

namespace ogc::fast {

namespace {

/// Throws compare::ResourceError if so many worlds of this scene need more memory than the machine has.
void expect_memory(const compare::Scene& scene, std::size_t worlds) {
  const std::size_t machine = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
                              static_cast<std::size_t>(sysconf(_SC_PAGESIZE)),
                    each = world_bytes(scene);
  if (each * worlds <= machine) return;
  const auto mebibytes = [](std::size_t bytes) { return std::to_string(bytes >> 20) + " MiB"; };
  throw compare::ResourceError(std::to_string(worlds) + " worlds need " + mebibytes(each * worlds) +
                               " of memory, and the machine has " + mebibytes(machine) + ": run at most " +
                               std::to_string(machine / each) + " worlds");
}

}  // namespace

std::unique_ptr<Worlds> start_worlds(Backend backend, std::span<const compare::Scene> scenes,
                                     const compare::SimulationOptions& options) {
  if (scenes.empty()) throw compare::InputError("worlds: give at least one scene");
  if (options.profile) throw compare::InputError("worlds have no times by stage; leave profile out");
  if (backend == Backend::cpu) {
    expect_memory(scenes.front(), scenes.size());
    return start_cpu_worlds(scenes, options);
  }
#if defined(OGC_HAS_CUDA)
  return start_cuda_worlds(scenes, options);
#else
  throw compare::ResourceError("backend cuda: " + backend_info(backend).description + ", or use --backend cpu");
#endif
}

}  // namespace ogc::fast
