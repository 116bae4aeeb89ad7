// How a kernel comes after another. In a graph a launch costs its latency each time, and a detection is nine dependent
// launches of a few microseconds each. So a launch may be brought to the device while the one before it still runs
// (programmatic dependent launch): `follow_launch` is the first thing that such a kernel does, and it waits there until
// the one before has ended and what it wrote can be seen. The next launch is let in only after this wait, so that
// whatever came two launches before has ended too; a kernel that reads ahead of its wait (fast/cuda/team.cuh) relies on
// that.
#pragma once

#include <cuda_runtime.h>

namespace ogc::fast {

__device__ inline void follow_launch() {
  cudaGridDependencySynchronize();
  cudaTriggerProgrammaticLaunchCompletion();
}

/// `early`: it need not wait for the end of the launch before it to be brought to the device, because its kernel does.
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
