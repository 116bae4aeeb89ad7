// Uses programmatic dependent launch. In a graph each launch adds its latency, and a detection has nine dependent
// launches of a few microseconds each. So the device may begin a launch while the previous one still runs. Such a
// kernel first calls `follow_launch`, which waits until the previous launch has ended and its writes are visible. Only
// after this wait does the kernel let the next launch begin, so the launch before the previous one has ended, too.
// Kernels that read before their wait (fast/cuda/team.cuh) rely on this.
#pragma once

#include <cuda_runtime.h>

namespace ogc::fast {

/// Waits for the previous launch, then lets the next one begin. It is the first statement of a kernel.
__device__ inline void follow_launch() {
  cudaGridDependencySynchronize();
  cudaTriggerProgrammaticLaunchCompletion();
}

/// Launches a kernel. `early`: the device may begin the kernel before the previous launch has ended, because the kernel
/// itself waits for this end.
template <class... Parameters, class... Arguments>
void launch_kernel(cudaStream_t stream, bool early, void (*kernel)(Parameters...), int blocks, int threads,
                   const Arguments&... arguments) {
  cudaLaunchAttribute attribute{};
  attribute.id = cudaLaunchAttributeProgrammaticStreamSerialization;
  attribute.val.programmaticStreamSerializationAllowed = 1;
  cudaLaunchConfig_t launch{};
  launch.gridDim = dim3(static_cast<unsigned>(blocks));
  launch.blockDim = dim3(static_cast<unsigned>(threads));
  launch.stream = stream;
  launch.attrs = &attribute;
  launch.numAttrs = early ? 1 : 0;
  cudaLaunchKernelEx(&launch, kernel, arguments...);
}

}  // namespace ogc::fast
