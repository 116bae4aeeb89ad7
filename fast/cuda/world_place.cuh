// Runs the programs of worlds on the device, one block a world, in one launch. A block copies each instruction and its
// arguments to shared memory while it runs the one before, so that no call waits for its arguments.
#pragma once

#include <cstddef>

#include <cuda_pipeline.h>
#include <cuda_runtime.h>

#include "fast/cuda/buffer.cuh"
#include "fast/cuda/check.cuh"
#include "fast/cuda/world_block.cuh"
#include "fast/kernels/sweep/sums.hpp"
#include "fast/worlds/backend.hpp"

namespace ogc::fast {

/// Memory of the device, for Pool.
struct CudaData {
  static void* allocate(std::size_t bytes) { return device_allocate(bytes); }
  static void free(void* memory) noexcept { device_free(memory); }
  static void fill_zero(void* memory, std::size_t bytes) { OGC_CUDA_CHECK(cudaMemset(memory, 0, bytes)); }
  static void copy_in(void* to, const void* from, std::size_t bytes) {
    OGC_CUDA_CHECK(cudaMemcpy(to, from, bytes, cudaMemcpyHostToDevice));
  }
  static void copy_out(void* to, const void* from, std::size_t bytes) {
    OGC_CUDA_CHECK(cudaMemcpy(to, from, bytes, cudaMemcpyDeviceToHost));
  }
};

/// Memory of the host that the device reads and writes, for Pool. The host may use it when no launch runs.
struct CudaShared {
  static void* allocate(std::size_t bytes) {
    void* memory = nullptr;
    OGC_CUDA_CHECK(cudaHostAlloc(&memory, bytes, cudaHostAllocMapped));
    return memory;
  }
  static void free(void* memory) noexcept { cudaFreeHost(memory); }
  static void fill_zero(void* memory, std::size_t bytes) { std::memset(memory, 0, bytes); }
  static void copy_in(void* to, const void* from, std::size_t bytes) { std::memcpy(to, from, bytes); }
  static void copy_out(void* to, const void* from, std::size_t bytes) { std::memcpy(to, from, bytes); }
};

/// Runs an operation with the threads of a block.
template <class Operation>
__device__ void run_operation(const void* arguments, void* memory) {
  (*static_cast<const Operation*>(arguments))(DeviceBlock{memory});
}

/// The address of an operation's code on the device. A kernel that tells the address would take longer to compile: with
/// each kernel the compiler compiles all functions whose addresses are taken.
template <class Operation>
__device__ Code device_code = run_operation<Operation>;

/// Runs worlds on the device.
struct CudaPlace {
  using Data = CudaData;
  using Shared = CudaShared;
  /// Two sums only: all operations are compiled as one program.
  using Sums = SumList<GatherSurfaces, GatherAll>;

  template <class Operation>
  static Code code() {
    static const Code code = [] {
      Code on_device = nullptr;
      OGC_CUDA_CHECK(cudaMemcpyFromSymbol(&on_device, device_code<Operation>, sizeof(on_device)));
      return on_device;
    }();
    return code;
  }
  static int device() {
    int number = 0;
    OGC_CUDA_CHECK(cudaGetDevice(&number));
    return number;
  }
  static void synchronize() { OGC_CUDA_CHECK(cudaDeviceSynchronize()); }
  static double run(const WorldJob* jobs, int count);
};

}  // namespace ogc::fast
