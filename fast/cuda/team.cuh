// Teams of W neighbouring lanes, with the bits of SerialTeam<W>, in two forms.
//
// SpreadTeam: a block is as many warps as a sum has parts: warp p runs part p of 32/W teams, so that no warp waits for another sort of term and the chain of
// dependent instructions, which is what a small launch costs, is the longest part's and not all of them. Lanes leave what they have in shared memory,
// warp 0 adds the parts in their order and then the lanes.
//
// SerialLaneTeam: the same lanes run one part after the other. A launch that fills the device anyway pays for instructions, and here no warp waits at a barrier.
//
// The tree is a butterfly: at distance s every lane adds its partner l xor s. By induction all lanes l with the same l mod s hold the same bits after that
// round: the two partners add the same two numbers, in opposite order, and IEEE addition is commutative. Lane l < s adds lanes[l] + lanes[l + s], which is
// SerialTeam's tree, so every lane ends with SerialTeam's total. No product feeds these additions (a shuffle stands between), so contraction cannot
// change them either.
//
// A launch may overlap the one before it (programmatic dependent launch): what a part loads is read at once, then `sum` waits for that launch to end. The
// next launch is let in only after this wait, so whatever came two launches before has ended too.
#pragma once

#include <cstring>
#include <type_traits>

#include <cuda_runtime.h>

#include "fast/kernels/qualifiers.hpp"

namespace ogc::fast {

namespace detail {

template <class Accumulator>
__device__ constexpr int words() {
  static_assert(std::is_trivially_copyable_v<Accumulator> && sizeof(Accumulator) % sizeof(unsigned) == 0, "an accumulator is made of 4-byte words");
  static_assert(alignof(Accumulator) <= alignof(unsigned));
  return sizeof(Accumulator) / sizeof(unsigned);
}

template <class Accumulator>
__device__ Accumulator from_partner(const Accumulator& mine, int distance) {
  unsigned word[words<Accumulator>()];
  std::memcpy(word, &mine, sizeof(mine));
#pragma unroll
  for (int k = 0; k < words<Accumulator>(); ++k) word[k] = __shfl_xor_sync(0xffffffffu, word[k], distance);
  Accumulator partner;
  std::memcpy(&partner, word, sizeof(partner));
  return partner;
}

/// The total of W lanes, in each of them.
template <int W, class Accumulator>
__device__ Accumulator total_of_lanes(Accumulator total) {
#pragma unroll
  for (int s = W / 2; s > 0; s /= 2) total += from_partner(total, s);
  return total;
}

/// This lane's items of a part. With `begins`: the first is loaded before the launch before this one has ended, and the next launch is let in after that.
template <int W, bool begins, class Part, class Accumulator>
__device__ void add_part(const Part& part, int lane, Accumulator& own) {
  int k = lane;
  const bool any = k < part.count;
  decltype(part.load(0)) loaded{};
  if (any) loaded = part.load(k);
  if constexpr (begins) {
    cudaGridDependencySynchronize();
    cudaTriggerProgrammaticLaunchCompletion();
  }
  if (any) part.add(loaded, own);
  for (k += W; k < part.count; k += W) part.add(part.load(k), own);
}

}  // namespace detail

/// `present` of both: false for a team that only fills a block. `sum` of both: as SerialTeam::sum; once in a kernel, by every thread of the block.
template <int W>
class SpreadTeam {
 public:
  static_assert(W >= 1 && W <= 32 && (W & (W - 1)) == 0, "W is a power of two, at most 32");
  static constexpr int width = W;

  __device__ explicit SpreadTeam(bool present) : present_(present) {}

  /// With as many parts as the block has warps.
  template <class Accumulator, class... Parts>
  __device__ Accumulator sum(const Parts&... parts) const {
    constexpr int others = sizeof...(Parts) - 1;
    __shared__ unsigned memory[others > 0 ? others : 1][32 * detail::words<Accumulator>()];  // a shared object may not have an initialiser
    const auto shared = [](int p) { return reinterpret_cast<Accumulator*>(memory[p]) + threadIdx.x % 32; };
    Accumulator own{};
    int p = 0;
    ((p++ == warp() ? detail::add_part<W, true>(parts, lane(), own) : void()), ...);
    if (warp() > 0) *shared(warp() - 1) = own;
    if constexpr (others > 0) __syncthreads();
    Accumulator total{};
    if (warp() > 0) return total;
    total += own;
    for (int k = 0; k < others; ++k) total += *shared(k);
    return detail::total_of_lanes<W>(total);
  }

  __device__ bool leader() const { return present_ && warp() == 0 && lane() == 0; }

 private:
  __device__ static int warp() { return static_cast<int>(threadIdx.x) / 32; }
  __device__ static int lane() { return static_cast<int>(threadIdx.x) & (W - 1); }

  bool present_;
};

template <int W>
class SerialLaneTeam {
 public:
  static_assert(W >= 1 && W <= 32 && (W & (W - 1)) == 0, "W is a power of two, at most 32");
  static constexpr int width = W;

  __device__ explicit SerialLaneTeam(bool present) : present_(present) {}

  template <class Accumulator, class First, class... Others>
  __device__ Accumulator sum(const First& first, const Others&... others) const {
    Accumulator total{};
    add<true>(first, total);
    (add<false>(others, total), ...);
    return detail::total_of_lanes<W>(total);
  }

  __device__ bool leader() const { return present_ && lane() == 0; }

 private:
  __device__ static int lane() { return static_cast<int>(threadIdx.x) & (W - 1); }

  template <bool begins, class Part, class Accumulator>
  __device__ static void add(const Part& part, Accumulator& total) {
    Accumulator own{};
    detail::add_part<W, begins>(part, lane(), own);
    total += own;
  }

  bool present_;
};

}  // namespace ogc::fast
