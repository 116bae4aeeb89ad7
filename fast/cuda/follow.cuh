// Uses programmatic dependent launch. In a graph a launch costs its latency each time, and a detection is nine
// dependent launches of a few microseconds each. So the device may begin a launch while the one before it still runs:
// such a kernel calls `follow_launch` first, which waits until the one before has ended and its writes are visible. The
// kernel lets the next launch in only after this wait, so that the launch two before has ended, too; a kernel that
// reads ahead of its wait (fast/cuda/team.cuh) relies on that.
#pragma once

#include <cuda_runtime.h>

namespace ogc::fast {

/// Waits for the launch before, then lets the next one in. It is the first statement of a kernel.
__device__ inline void follow_launch() {
  cudaGridDependencySynchronize();
  cudaTriggerProgrammaticLaunchCompletion();
}

/// Launches a kernel. `early`: the device may begin it before the launch before it has ended, because the kernel waits
/// for that itself.
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
