// Runs the operations of a world with the threads of one block (fast/worlds/operations.hpp). Loops give each thread
// every k-th item; teams, groups and searches take whole warps, as in the kernels of fast/cuda/backend.cuh.
#pragma once

#include <cuda_runtime.h>

#include "fast/cuda/least.cuh"
#include "fast/cuda/search.cuh"
#include "fast/cuda/team.cuh"
#include "fast/worlds/operations.hpp"

namespace ogc::fast {

/// Threads of a block. With fewer, more worlds run at once, but each takes longer than that gains
/// (fast/PERFORMANCE.md).
inline constexpr int world_threads = 256;
/// Number of blocks that a multiprocessor runs at once. It limits the registers of a thread.
inline constexpr int resident_world_blocks = 2;

/// Temporary memory of a block's operations [B].
inline constexpr std::size_t world_memory = sizeof(SearchMemory) * world_threads / 32;
static_assert(sizeof(SearchMemory) >= sizeof(int) * world_threads / 32, "a scan's sums fit");

/// A team of W neighbouring threads that compute the parts of a sum one after the other. It has the terms and the order
/// of fast/kernels/team.hpp. Teams of a block do not wait for each other.
template <int W>
class WorldTeam : public NeighbourLanes<W> {
  using NeighbourLanes<W>::lane;

 public:
  static constexpr int width = W;
  static constexpr bool moves_totals = false;

  /// `present`: false for a team without an item, which only fills up a warp.
  __device__ explicit WorldTeam(bool present) : present_(present) {}

  __device__ static void prefetch(const void*, int) {}
  __device__ static void leave() {}

  template <class Accumulator, class... Parts>
  __device__ Accumulator sum(const Parts&... parts) const {
    Accumulator total{};
    (add(parts, total), ...);
    return detail::total_of_lanes<W>(total);
  }

  __device__ static bool holds_total() { return true; }
  __device__ bool leader() const { return present_ && lane() == 0; }

 private:
  template <class AnyPart, class Accumulator>
  __device__ static void add(const AnyPart& part, Accumulator& total) {
    Accumulator own{};
    detail::add_part<W, false>(part, lane(), own);
    total += own;
  }

  bool present_;
};

/// The threads of a block.
struct DeviceBlock {
  void* memory;  ///< shared memory of world_memory bytes

  __device__ static int thread() { return static_cast<int>(threadIdx.x); }
  __device__ static constexpr int threads() { return world_threads; }
  __device__ static void barrier() { __syncthreads(); }

  /// An operation's functor lies in shared memory. The compiler would read its members before a loop and keep them in
  /// registers, more than there are; it does not know that this is the same functor in each turn.
  template <class F>
  __device__ static const F& reread(const F& f) {
    auto address = static_cast<unsigned>(__cvta_generic_to_shared(&f));
    asm volatile("" : "+r"(address));
    return *static_cast<const F*>(__cvta_shared_to_generic(address));
  }

  /// A warp's teams take neighbouring items. Teams beyond the last item compute the last item and write nothing,
  /// because all threads of a warp call a team's functions together.
  template <int W, class F>
  __device__ void team_loop(int n, const F& f) const {
    constexpr int in_warp = 32 / W;
    for (int first = thread() / 32 * in_warp; first < n; first += threads() / W) {
      const int i = first + thread() % 32 / W;
      reread(f)(i < n ? i : n - 1, WorldTeam<W>(i < n));
    }
  }
  template <int W, class F>
  __device__ void group_loop(int n, const F& f) const {
    for (int i = thread() / W; i < n; i += threads() / W) reread(f)(i, GroupLanes<W>{});
  }
  template <class F>
  __device__ void row_loop(int n, const int* offsets, const float* values, const F& f) const {
    for (int i = thread() / 32; i < n; i += threads() / 32) {
      const float own = least_of_row(values + offsets[i], offsets[i + 1] - offsets[i], F::rank);
      const float after = __shfl_sync(0xffffffffu, own, F::rank);
      if (thread() % 32 == 0) f(i, own, after);
    }
  }
  /// A warp runs up to largest_group searches at a time, which are far apart, because long searches are neighbours.
  template <class Query>
  __device__ void search(const Searches<Query>& searches) const {
    if (searches.query.is_off()) return;
    const int warps = threads() / 32, warp = thread() / 32;
    for (int base = 0; base < searches.count; base += warps * largest_group) {
      const int first = base + warp, end = min(searches.count, base + warps * largest_group);
      if (first >= end) continue;
      WarpSearch<Query>(searches, static_cast<SearchMemory*>(memory)[warp])
          .run(first, warps, (end - first + warps - 1) / warps);
    }
  }
  /// Scans as many items at a time as there are threads.
  __device__ void scan(const Scan& scan) const {
    int* of_warp = static_cast<int*>(memory);
    const int warp = thread() / 32, lane = thread() % 32;
    int before = 0;
    for (int base = 0; base < scan.count; base += threads()) {
      const int i = base + thread(), item = i < scan.count ? scan.in[i] : 0;
      int upto = item;
      for (int distance = 1; distance < 32; distance *= 2) {
        const int other = __shfl_up_sync(0xffffffffu, upto, distance);
        if (lane >= distance) upto += other;
      }
      if (lane == 31) of_warp[warp] = upto;
      barrier();
      int total = 0;
      for (int w = 0; w < threads() / 32; ++w) {
        if (w == warp) upto += total;
        total += of_warp[w];
      }
      if (i < scan.count) scan.out[i] = before + upto - item;
      before += total;
      barrier();
    }
    if (thread() == 0) scan.out[scan.count] = before;
  }
};

}  // namespace ogc::fast
