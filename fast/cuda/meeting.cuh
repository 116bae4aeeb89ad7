// Lets the devices that divide a simulation meet inside their graphs, without the host. Each device has a flag for each
// other one. When all blocks of a launch have sent what they had to send, the last block raises its flag on all other
// devices, and waits until they have raised theirs. A device that waits makes no progress, so the host launches a graph
// when all parts are ready (CudaBackend::launch). Outside a graph the host's threads meet, so that no device waits:
// tools that run one kernel at a time hold up nobody.
#pragma once

#include <cstdint>

#include <cuda_runtime.h>

#include "fast/cuda/follow.cuh"

namespace ogc::fast {

/// Cycles after which a device gives up, so that a part that has failed ends the others: a minute or more at 2 GHz.
inline constexpr long long longest_wait = 120'000'000'000;

/// What a device needs for its meetings.
struct MeetingPlace {
  int own, count;                      ///< number of this part; number of parts
  std::uint32_t* meetings;             ///< number of meetings so far
  unsigned* done;                      ///< blocks of the current launch that have sent their items
  std::uint32_t* flags;                ///< by part: number of meetings to which it has come; written by that part
  std::uint32_t* const* others_flags;  ///< by part: its `flags`
};

__device__ inline void raise_flag(std::uint32_t* flag, std::uint32_t number) {
  asm volatile("st.release.sys.global.u32 [%0], %1;" ::"l"(flag), "r"(number) : "memory");
}
__device__ inline std::uint32_t read_flag(const std::uint32_t* flag) {
  std::uint32_t number;
  asm volatile("ld.acquire.sys.global.u32 %0, [%1];" : "=r"(number) : "l"(flag) : "memory");
  return number;
}

/// Ends a meeting after the host's threads have met: runs end(0) and counts the meeting. Runs once.
template <class G>
struct EndMeeting {
  G end;
  std::uint32_t* meetings;  ///< as in MeetingPlace

  __device__ void operator()(int) const {
    end(0);
    ++*meetings;
  }
};

/// Runs send(i) for i < n, waits for the other parts, then runs end(0) and counts the meeting.
template <class F, class G>
__global__ void __launch_bounds__(128) run_meeting(MeetingPlace place, int n, F send, G end) {
  follow_launch();
  const int stride = static_cast<int>(gridDim.x * blockDim.x);
  for (int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x); i < n; i += stride) send(i);
  __threadfence_system();
  __syncthreads();
  __shared__ bool is_last;
  if (threadIdx.x == 0) is_last = atomicAdd(place.done, 1U) + 1 == gridDim.x;
  __syncthreads();
  if (!is_last) return;
  __threadfence_system();  // what other blocks have sent comes before the flag
  const std::uint32_t number = *place.meetings + 1;
  for (int p = static_cast<int>(threadIdx.x); p < place.count; p += static_cast<int>(blockDim.x)) {
    if (p == place.own) continue;
    raise_flag(place.others_flags[p] + place.own, number);
    const long long begin = static_cast<long long>(clock64());
    // The numbers differ by at most one; the difference stays right when they pass 2³².
    while (static_cast<std::int32_t>(read_flag(place.flags + p) - number) < 0)
      if (static_cast<long long>(clock64()) - begin > longest_wait) __trap();
  }
  __syncthreads();
  if (threadIdx.x != 0) return;
  end(0);
  *place.done = 0;
  *place.meetings = number;
}

}  // namespace ogc::fast
