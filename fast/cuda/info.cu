#include <string>

#include <cuda_runtime.h>

#include "compare/problem/error.hpp"
#include "fast/cuda/check.cuh"
#include "fast/cuda/cuda.hpp"

namespace ogc::fast {
namespace {

__global__ void any_kernel() {}

std::string version(int number) { return std::to_string(number / 1000) + "." + std::to_string(number % 1000 / 10); }

BackendInfo unusable(const std::string& why) {
  cudaGetLastError();
  return {true, false, why};
}

}  // namespace

BackendInfo cuda_info() {
  int devices = 0, runtime = 0, driver = 0;
  cudaRuntimeGetVersion(&runtime);
  cudaDriverGetVersion(&driver);
  if (driver == 0) return unusable("no CUDA device: this machine has no NVIDIA driver");
  if (driver / 1000 < runtime / 1000) {
    return unusable("the NVIDIA driver is too old: it knows CUDA " + version(driver) + ", this program needs " +
                    version(runtime) + ": update the driver");
  }
  const cudaError_t count_error = cudaGetDeviceCount(&devices);
  if (count_error != cudaSuccess || devices == 0) {
    return unusable(std::string("no CUDA device: ") +
                    (count_error != cudaSuccess ? cudaGetErrorString(count_error) : "the driver shows none"));
  }
  cudaDeviceProp properties{};
  int device = 0;
  cudaFuncAttributes attributes{};
  if (cudaGetDevice(&device) != cudaSuccess || cudaGetDeviceProperties(&properties, device) != cudaSuccess) {
    return unusable("no CUDA device: its properties can't be read");
  }
  const cudaError_t image_error = cudaFuncGetAttributes(&attributes, any_kernel);
  if (image_error != cudaSuccess) {
    return unusable(std::string(properties.name) + " (compute capability " + std::to_string(properties.major) + "." +
                    std::to_string(properties.minor) + ") can't run this program's kernels (" +
                    cudaGetErrorString(image_error) + "): build on it, or with CMAKE_CUDA_ARCHITECTURES set to it");
  }
  return {true, true, std::string(properties.name) + ", CUDA " + version(runtime)};
}

std::size_t cuda_free_bytes() {
  const BackendInfo info = cuda_info();
  if (!info.usable) throw compare::ResourceError(info.description + "; run with the backend cpu");
  std::size_t free = 0, total = 0;
  OGC_CUDA_CHECK(cudaMemGetInfo(&free, &total));
  return free;
}

}  // namespace ogc::fast
