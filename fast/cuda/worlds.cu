// Instantiates worlds on the device. Their operations are one program, because blocks call them by address.
#include <algorithm>

#include "compare/problem/error.hpp"
#include "fast/cuda/cuda.hpp"
#include "fast/cuda/world_place.cuh"
#include "fast/stages/update_vertices.hpp"
#include "fast/worlds.hpp"
#include "fast/worlds/resident.hpp"

namespace ogc::fast {

namespace {

/// Begins to copy an instruction to shared memory; all threads of the block call it.
__device__ void fetch(std::byte* to, const std::byte* from, int size) {
  constexpr int part = 16;
  for (int at = part * static_cast<int>(threadIdx.x); at < size; at += part * static_cast<int>(blockDim.x))
    __pipeline_memcpy_async(to + at, from + at, part);
  __pipeline_commit();
}

/// Waits for the instruction that was fetched last, and for all threads.
__device__ void wait_for_fetch() {
  __pipeline_wait_prior(0);
  __syncthreads();
}

/// Returns whether *flag is not 0, to all threads of the block.
__device__ bool is_set(const int* flag) {
  return __syncthreads_or(threadIdx.x == 0 && *static_cast<const volatile int*>(flag) != 0 ? 1 : 0) != 0;
}

__device__ const Instruction& head(const std::byte* at) { return *reinterpret_cast<const Instruction*>(at); }

/// Runs a program. `instructions`: room for two instructions, of which one runs while the next one arrives.
__device__ void run_program(const std::byte* program, int size, std::byte* instructions, void* memory) {
  std::byte *own = instructions, *other = instructions + largest_instruction;
  __syncthreads();
  fetch(own, program, head(program).size);
  for (int at = 0; at < size;) {
    wait_for_fetch();
    const Instruction instruction = head(own);
    const int next = at + instruction.size;
    if (instruction.next_size > 0) fetch(other, program + next, instruction.next_size);
    at = next;
    if (instruction.kind == Instruction::Kind::call) {
      instruction.code(own + sizeof(Instruction), memory);
    } else if (is_set(instruction.flag) == (instruction.kind == Instruction::Kind::go_if)) {
      at = instruction.target;
      wait_for_fetch();
      if (at < size) fetch(other, program + at, head(program + at).size);
    }
    std::byte* const done = own;
    own = other;
    other = done;
  }
}

/// Runs a world's segments. Each block runs one world.
__global__ void __launch_bounds__(world_threads, resident_world_blocks) run_world(const WorldJob* jobs) {
  extern __shared__ __align__(16) std::byte shared[];
  const WorldJob job = jobs[blockIdx.x];
  for (int s = 0; s < job.count; ++s) {
    const Segment segment = job.segments[s];
    for (int k = 0; k < segment.times; ++k) {
      __syncthreads();
      if (segment.goes_on != nullptr && !is_set(segment.goes_on)) break;
      run_program(segment.program, segment.size, shared, shared + 2 * largest_instruction);
    }
  }
}

/// The stack of a thread: the compiler cannot know its depth, because operations are called by address.
constexpr std::size_t stack_bytes = 4096;

}  // namespace

double CudaPlace::run(const WorldJob* jobs, int count) {
  static cudaEvent_t begin = nullptr, end = nullptr;
  constexpr std::size_t shared_bytes = 2 * largest_instruction + world_memory;
  if (begin == nullptr) {
    OGC_CUDA_CHECK(cudaEventCreate(&begin));
    OGC_CUDA_CHECK(cudaEventCreate(&end));
    OGC_CUDA_CHECK(
        cudaFuncSetAttribute(run_world, cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(shared_bytes)));
    OGC_CUDA_CHECK(cudaDeviceSetLimit(cudaLimitStackSize, stack_bytes));
  }
  OGC_CUDA_CHECK(cudaEventRecord(begin));
  run_world<<<count, world_threads, shared_bytes>>>(jobs);
  OGC_CUDA_CHECK(cudaGetLastError());
  OGC_CUDA_CHECK(cudaEventRecord(end));
  OGC_CUDA_CHECK(cudaEventSynchronize(end));
  float milliseconds = 0;
  OGC_CUDA_CHECK(cudaEventElapsedTime(&milliseconds, begin, end));
  return static_cast<double>(milliseconds);
}

std::unique_ptr<Worlds> start_cuda_worlds(std::span<const compare::Scene> scenes,
                                          const compare::SimulationOptions& options, int list_capacity) {
  const BackendInfo info = cuda_info();
  if (!info.usable) throw compare::ResourceError(info.description + "; run with the backend cpu");
  return std::make_unique<ResidentWorlds<CudaPlace>>(scenes, options, info.description, list_capacity);
}

}  // namespace ogc::fast
