// Finds the smallest numbers of a row with a warp: lane k holds the k-th smallest, from 0. The row is read in chunks of
// 32, which are sorted and merged. A chunk is skipped if all its numbers are at least the largest number that is
// needed.
#pragma once

#include <cuda_runtime.h>

namespace ogc::fast {

/// Returns the smaller of this lane's number and its partner's if `low`, else the larger one. The partner is the lane
/// xor `distance`. Numbers are not NaN.
__device__ inline float exchanged(float own, int distance, bool low) {
  const float other = __shfl_xor_sync(0xffffffffu, own, distance);
  return low ? fminf(own, other) : fmaxf(own, other);
}

/// Sorts a bitonic row of 32 numbers, one in each lane, in ascending order.
__device__ inline float merged(float own, int lane) {
#pragma unroll
  for (int distance = 16; distance > 0; distance /= 2) own = exchanged(own, distance, (lane & distance) == 0);
  return own;
}

/// Sorts any row of 32 numbers in ascending order. First sorts runs of 2, 4, 8 and 16 numbers, every second run in
/// descending order, then the whole row.
__device__ inline float sorted(float own, int lane) {
#pragma unroll
  for (int run = 2; run < 32; run *= 2)
#pragma unroll
    for (int distance = run / 2; distance > 0; distance /= 2)
      own = exchanged(own, distance, ((lane & distance) == 0) == ((lane & run) == 0));
  return merged(own, lane);
}

/// Returns in lane k ≤ rank < 32 the k-th smallest of `count` numbers, counted from 0, or infinity if k ≥ count. All 32
/// threads of a warp call it together.
__device__ inline float least_of_row(const float* values, int count, int rank) {
  const int lane = static_cast<int>(threadIdx.x) % 32;
  const float infinite = __int_as_float(0x7f800000);
  float least = infinite;
  for (int begin = 0; begin < count; begin += 32) {
    const float own = begin + lane < count ? values[begin + lane] : infinite;
    if (!__any_sync(0xffffffffu, own < __shfl_sync(0xffffffffu, least, rank))) continue;
    // In each lane, takes the smaller number of an ascending and a descending row. These are the 32 smallest numbers of
    // both rows, and they form a bitonic row.
    const float descending = __shfl_xor_sync(0xffffffffu, sorted(own, lane), 31);
    least = merged(fminf(least, descending), lane);
  }
  return least;
}

}  // namespace ogc::fast
