// Where the two backends become contestants. Only this file and contact_sets.cpp know whether the program was built
// with CUDA.
#include "fast/contestant.hpp"

#include "compare/problem/error.hpp"
#include "fast/cpu/cpu.hpp"
#if defined(OGC_HAS_CUDA)
#include "fast/cuda/cuda.hpp"
#endif

namespace ogc::fast {

namespace {

BackendInfo device_info() {
#if defined(OGC_HAS_CUDA)
  return cuda_info();
#else
  return {false, false, "this program was built without CUDA: install nvcc and build with the default preset"};
#endif
}

#if defined(OGC_HAS_CUDA)
/// The guess by certificate of pairs was never run on a device; until it was, it is refused there.
compare::Contestant without_guess_by_pairs(compare::Contestant contestant) {
  contestant.has_steps_by_pairs = false;
  contestant.start = [start = contestant.start](const compare::Scene& scene,
                                                const compare::SimulationOptions& options) {
    if (scene.settings.guess == compare::Guess::pairs)
      throw compare::InputError(
          "setting 'guess' can't be 'pairs' on CUDA, where it was never tried; "
          "give guess=rounds or --backend cpu");
    return start(scene, options);
  };
  return contestant;
}
#endif

}  // namespace

BackendInfo backend_info(Backend backend) { return backend == Backend::cpu ? cpu_info() : device_info(); }

compare::Contestant contestant(Backend backend, [[maybe_unused]] const LaunchShape& shape) {
  if (backend == Backend::cpu) return cpu_contestant();
#if defined(OGC_HAS_CUDA)
  return without_guess_by_pairs(cuda_contestant(shape));
#else
  throw compare::ResourceError("backend cuda: " + device_info().description + ", or use --backend cpu");
#endif
}

}  // namespace ogc::fast
