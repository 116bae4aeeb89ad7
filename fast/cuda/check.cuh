// Defines the one macro for CUDA calls. A failed call becomes an exception that names the call, its place, and the
// runtime's error; an error that an earlier kernel left behind surfaces at the next call that waits, and the text says
// so.
#pragma once

#include <string>

#include <cuda_runtime.h>

namespace ogc::fast {

/// Throws compare::ResourceError if device or memory is missing, std::runtime_error otherwise. `what` is the call or
/// the kernel.
[[noreturn]] void throw_cuda_error(cudaError_t error, const char* what, const char* file, int line);

/// Returns the readable name of a type: a failed launch names its functor, and with it the stage.
std::string readable_type(const char* mangled);

}  // namespace ogc::fast

#define OGC_CUDA_CHECK(call)                                                                           \
  do {                                                                                                 \
    const cudaError_t ogc_error = (call);                                                              \
    if (ogc_error != cudaSuccess) ::ogc::fast::throw_cuda_error(ogc_error, #call, __FILE__, __LINE__); \
  } while (false)
