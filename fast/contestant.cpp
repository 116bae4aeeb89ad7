// Turns the two backends into contestants. Only this file, contact_sets.cpp and guard.cpp depend on whether the program
// was built with CUDA.
#include "fast/contestant.hpp"

#include <stdexcept>

#include "compare/problem/error.hpp"
#include "fast/cpu/cpu.hpp"
#include "fast/resident_state.hpp"
#if defined(OGC_HAS_CUDA)
#include "fast/cuda/cuda.hpp"
#endif

namespace ogc::fast {

namespace {

BackendInfo device_info() {
#if defined(OGC_HAS_CUDA)
  return cuda_info();
#else
  return {false, false, "this program was built without CUDA: install nvcc and configure it with -DOGC_CUDA=ON"};
#endif
}

}  // namespace

ResidentState& resident_state(compare::Simulation& simulation) {
  auto* state = dynamic_cast<ResidentState*>(&simulation);
  if (state == nullptr) throw std::invalid_argument("resident_state: the simulation is of another library");
  return *state;
}

BackendInfo backend_info(Backend backend) { return backend == Backend::cpu ? cpu_info() : device_info(); }

compare::Contestant contestant(Backend backend, const LaunchShape& shape) {
  if (backend == Backend::cpu) return cpu_contestant(shape.devices);
#if defined(OGC_HAS_CUDA)
  return cuda_contestant(shape);
#else
  throw compare::ResourceError("backend cuda: " + device_info().description + ", or use the backend cpu");
#endif
}

}  // namespace ogc::fast
