#include <cxxabi.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "compare/problem/error.hpp"
#include "fast/cuda/buffer.cuh"
#include "fast/cuda/check.cuh"

namespace ogc::fast {
namespace {

std::string mebibytes(std::size_t bytes) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f MiB", static_cast<double>(bytes) / (1024.0 * 1024.0));
  return text;
}

bool is_missing_resource(cudaError_t error) {
  return error == cudaErrorMemoryAllocation || error == cudaErrorNoDevice || error == cudaErrorInsufficientDriver ||
         error == cudaErrorNoKernelImageForDevice || error == cudaErrorDevicesUnavailable ||
         error == cudaErrorSystemNotReady;
}

}  // namespace

void throw_cuda_error(cudaError_t error, const char* what, const char* file, int line) {
  cudaGetLastError();
  std::string text = std::string("CUDA: ") + cudaGetErrorName(error) + " (" + cudaGetErrorString(error) + ") in " +
                     what + " at " + file + ":" + std::to_string(line);
  if (is_missing_resource(error))
    throw compare::ResourceError(text + "; run with the backend cpu, or on a machine with a free device");
  throw std::runtime_error(
      text + "; the fault may lie in an earlier kernel: run the same command under compute-sanitizer to find it");
}

void require_readable(int device, const char* argument, const void* memory) {
  if (memory == nullptr) return;
  cudaPointerAttributes attributes{};
  OGC_CUDA_CHECK(cudaPointerGetAttributes(&attributes, memory));
  if (attributes.devicePointer == nullptr)
    throw compare::InputError(std::string(argument) + ": it is not in the memory of a CUDA device");
  if (attributes.type == cudaMemoryTypeDevice && attributes.device != device)
    throw compare::InputError(std::string(argument) + ": it is on device " + std::to_string(attributes.device) +
                              ", but this works on device " + std::to_string(device) + "; copy it there");
}

std::string readable_type(const char* mangled) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(abi::__cxa_demangle(mangled, nullptr, nullptr, &status), std::free);
  return status == 0 ? name.get() : mangled;
}

void* device_allocate(std::size_t bytes) {
  void* memory = nullptr;
  const cudaError_t error = cudaMalloc(&memory, bytes);
  if (error == cudaErrorMemoryAllocation) {
    cudaGetLastError();
    std::size_t free = 0, total = 0;
    OGC_CUDA_CHECK(cudaMemGetInfo(&free, &total));
    throw compare::ResourceError("out of device memory: asked for " + mebibytes(bytes) + ", " + mebibytes(free) +
                                 " of " + mebibytes(total) +
                                 " are free; use a smaller scene or detection_radius_cap, end other programs on the "
                                 "device, or run with the backend cpu");
  }
  OGC_CUDA_CHECK(error);
  return memory;
}

void device_free(void* memory) noexcept {
  if (memory != nullptr) cudaFree(memory);
}

}  // namespace ogc::fast
