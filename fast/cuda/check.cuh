// Defines the macro for CUDA calls. A failed call throws an exception with the call, its source line and the runtime's
// error. An error of an earlier kernel appears at the next call that waits; the message says so.
#pragma once

#include <string>

#include <cuda_runtime.h>

namespace ogc::fast {

/// Throws compare::ResourceError if a device or memory is missing, std::runtime_error otherwise. `what`: the call or
/// the kernel.
[[noreturn]] void throw_cuda_error(cudaError_t error, const char* what, const char* file, int line);

/// Throws compare::InputError, which begins with `argument`, unless the device can read memory at this address. Null is
/// accepted. A kernel that read what the device cannot would end all work of the process on it.
void require_readable(int device, const char* argument, const void* memory);

/// Returns the readable name of a type. The error of a failed launch contains the name of its functor, which identifies
/// the stage.
std::string readable_type(const char* mangled);

}  // namespace ogc::fast

#define OGC_CUDA_CHECK(call)                                                                           \
  do {                                                                                                 \
    const cudaError_t ogc_error = (call);                                                              \
    if (ogc_error != cudaSuccess) ::ogc::fast::throw_cuda_error(ogc_error, #call, __FILE__, __LINE__); \
  } while (false)
