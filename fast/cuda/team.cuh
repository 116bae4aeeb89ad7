// Defines teams of W team lanes, which are neighbouring threads of a warp. Their sums have the bits of SerialTeam<W>.
// There are three types.
//
// SpreadTeam: a block has as many warps as a sum has parts. Warp p computes part p of 32/W teams, so no warp waits for
// the terms of other parts. A small launch takes as long as its chain of dependent instructions; here this is the chain
// of the longest part, not of all parts. Team lanes store their parts in shared memory. Warp 0 adds the parts in their
// order and then the team lanes.
//
// SerialLaneTeam: the same team lanes compute one part after the other. A launch that fills the device takes as long as
// all its instructions, and here no warp waits for terms of other parts. All threads of a block together compute the
// terms of a pooled part, of all teams, as many at a time as there are threads. Then each team lane adds its own terms
// from shared memory, in their order. So a team with fifty contacts does not delay the others, and the chain of
// dependent reads has the block's average length.
//
// CompactTeam: SerialLaneTeams of consecutive items, whose totals move to the first threads of the block before the
// solve. The rows of a pooled part follow each other there, so that no thread seeks the team of a term.
//
// The sum of the team lanes is a butterfly: at distance s every team lane adds the number of its partner l xor s. After
// that round all team lanes with the same l mod s have the same bits: both partners add the same two numbers, in
// opposite order, and IEEE addition is commutative. Team lane l < s computes lanes[l] + lanes[l + s], as SerialTeam's
// tree does, so every team lane ends with SerialTeam's total. A shuffle separates these additions from all products, so
// contraction cannot change them.
//
// A launch may overlap the previous one (programmatic dependent launch): a part loads its first items at once, then
// `sum` waits for the previous launch to end. Only after this wait may the next launch begin, so all launches before
// the previous one have ended, too.
#pragma once

#include <cstring>
#include <type_traits>

#include <cuda_runtime.h>
#include <cub/block/block_scan.cuh>

#include "fast/kernels/team.hpp"
#include "fast/stages/team_choice.hpp"

namespace ogc::fast {

namespace detail {

/// Returns the size of an accumulator in words of 4 B, the unit of shuffles.
template <class Accumulator>
__device__ constexpr int words() {
  static_assert(std::is_trivially_copyable_v<Accumulator> && sizeof(Accumulator) % sizeof(unsigned) == 0,
                "an accumulator is made of 4-byte words");
  static_assert(alignof(Accumulator) <= alignof(unsigned));
  return sizeof(Accumulator) / sizeof(unsigned);
}

/// Returns the accumulator of the partner thread, which has this lane's number xor `distance`. All threads of the warp
/// call it together.
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

/// Returns the total of W team lanes, in each team lane.
template <int W, class Accumulator>
__device__ Accumulator total_of_lanes(Accumulator total) {
#pragma unroll
  for (int s = W / 2; s > 0; s /= 2) total += from_partner(total, s);
  return total;
}

/// Adds this team lane's items of a part. With `begins` the first item is loaded while the previous launch may still
/// run; then the thread waits for that launch and lets the next one begin.
template <int W, bool begins, class AnyPart, class Accumulator>
__device__ void add_part(const AnyPart& part, int lane, Accumulator& own) {
  int k = lane;
  decltype(load_item(part, 0)) loaded{};
  if (k < part.count) loaded = load_item(part, k);
  if constexpr (begins) {
    cudaGridDependencySynchronize();
    cudaTriggerProgrammaticLaunchCompletion();
  }
  while (k < part.count) {  // one call of add_item only: a second copy would cost instruction reads
    add_item(part, loaded, own);
    k += W;
    if (k < part.count) loaded = load_item(part, k);
  }
}

/// The terms of a pooled part in shared memory. There are two buffers, used alternately, because threads write the next
/// terms while others still read.
template <class Accumulator>
struct Terms {
  unsigned memory[2][serial_block_size][words<Accumulator>()];
};

/// Returns the terms that all parts of a sum share.
template <class Accumulator>
__device__ Terms<Accumulator>& terms_of_block() {
  __shared__ Terms<Accumulator> terms;
  return terms;
}

/// The shared memory of a block that finds the team of a term.
template <int W>
struct Pool {
  static constexpr int teams = serial_block_size / W;  ///< teams in a block
  using Scan = cub::BlockScan<int, serial_block_size>;
  typename Scan::TempStorage scan;
  /// by team: begin of its items in their array; offset of its items in the block
  int begins[teams], offsets[teams + 1];
};

/// Returns the pool that all parts of a sum share.
template <int W>
__device__ Pool<W>& pool_of_block() {
  __shared__ Pool<W> pool;
  return pool;
}

/// Adds this team lane's items of a pooled part. All threads of the block compute the part's terms together. A team
/// that is not `present` has no items.
template <int W, class Load, class Term, class Accumulator>
__device__ void add_pooled(const PooledPart<Load, Term>& part, bool present, Accumulator& own) {
  auto& [scan, begins, offsets] = pool_of_block<W>();
  auto& memory = terms_of_block<Accumulator>().memory;
  constexpr int teams = Pool<W>::teams;
  const int thread = static_cast<int>(threadIdx.x), team = thread / W, lane = thread % W;
  int offset = 0, total = 0;
  // The barrier also waits for threads that still read the previous part's terms.
  if (__syncthreads_or(present && part.count > 0 ? 1 : 0) == 0) return;
  typename Pool<W>::Scan(scan).ExclusiveSum(lane == 0 && present ? part.count : 0, offset, total);
  if (lane == 0) begins[team] = part.begin, offsets[team] = offset;
  if (thread == 0) offsets[teams] = total;
  __syncthreads();
  const int end = offsets[team + 1];
  int next = offsets[team] + lane;
  for (int base = 0, turn = 0; base < total; base += serial_block_size, turn ^= 1) {
    const int item = base + thread;
    if (item < total) {
      int owner = 0;
      for (int half = teams / 2; half > 0; half /= 2) owner += offsets[owner + half] <= item ? half : 0;
      *reinterpret_cast<Accumulator*>(memory[turn][thread]) = part.term(
          part.load(begins[owner] + item - offsets[owner]));
    }
    __syncthreads();
    for (const int here = min(end, base + serial_block_size); next < here; next += W)
      own += *reinterpret_cast<const Accumulator*>(memory[turn][next - base]);
  }
}

/// Adds this team lane's items of a pooled part, as add_pooled does, where the rows of the block's teams follow each
/// other.
template <int W, class Load, class Term, class Accumulator>
__device__ void add_pooled_rows(const PooledPart<Load, Term>& part, bool present, Accumulator& own) {
  auto& memory = terms_of_block<Accumulator>().memory;
  __shared__ int rows[2];  // begin of the first row, end of the last one; other parts have other variables
  const int thread = static_cast<int>(threadIdx.x);
  if (thread == 0) rows[0] = part.begin;
  // A team that is not present has the last item, whose row it does not add.
  if (thread == serial_block_size - 1) rows[1] = part.begin + part.count;
  __syncthreads();  // also waits for threads that still read the previous part's terms
  const int last = rows[1], end = present ? part.begin + part.count : 0;
  int next = part.begin + thread % W;
  for (int base = rows[0], turn = 0; base < last; base += serial_block_size, turn ^= 1) {
    const int item = base + thread;
    if (item < last) *reinterpret_cast<Accumulator*>(memory[turn][thread]) = part.term(part.load(item));
    __syncthreads();
    for (const int here = min(end, base + serial_block_size); next < here; next += W)
      own += *reinterpret_cast<const Accumulator*>(memory[turn][next - base]);
  }
}

}  // namespace detail

/// Implements the searches and minima of OneLane with W neighbouring threads of a warp.
template <int W>
class NeighbourLanes {
 public:
  template <class Is>
  __device__ int first(int count, int from, Is is) const {
    for (int base = from; base < count; base += W) {
      const int k = base + lane();
      const unsigned votes = __ballot_sync(everyone(), k < count && is(k)) >> begin();
      if (votes != 0) return base + __ffs(static_cast<int>(votes)) - 1;
    }
    return count;
  }
  template <class Of>
  __device__ double smallest(int count, double most, Of of) const {
    for (int k = lane(); k < count; k += W) most = smaller(most, of(k));
#pragma unroll
    for (int s = W / 2; s > 0; s /= 2) most = smaller(most, __shfl_xor_sync(everyone(), most, s));
    return most;
  }

 protected:
  /// `lane` returns the number of this thread in its team, `begin` the number of the team's first thread in the warp.
  __device__ static int lane() { return static_cast<int>(threadIdx.x) & (W - 1); }
  __device__ static int begin() { return static_cast<int>(threadIdx.x) & 31 & ~(W - 1); }

 private:
  /// Returns the mask of the team's lanes in the warp; other teams may be at another instruction.
  __device__ static unsigned everyone() { return (0xffffffffu >> (32 - W)) << begin(); }
};

/// The lanes of for_each_group: W neighbouring threads that share the work of one item.
template <int W>
struct GroupLanes : NeighbourLanes<W> {
  __device__ static bool leader() { return NeighbourLanes<W>::lane() == 0; }
};

/// A team with one warp for each part (head of this file). In all types of teams, `present` is false for a team
/// without an item, which only fills up a block. Every thread of the block must call `sum` or `leave` once. Both
/// functions wait for the previous launch, and the next launch relies on this wait.
template <int W>
class SpreadTeam : public NeighbourLanes<W> {
  using NeighbourLanes<W>::lane;

 public:
  static_assert(W >= 1 && W <= 32 && (W & (W - 1)) == 0, "W is a power of two, at most 32");
  static constexpr int width = W;  ///< W, team lanes
  static constexpr bool moves_totals = false;

  __device__ explicit SpreadTeam(bool present) : present_(present) {}

  /// Waits for the previous launch.
  __device__ static void leave() { cudaGridDependencySynchronize(); }

  __device__ static void prefetch(const void*, int) {}

  /// Returns the total in warp 0. The block must have as many warps as there are parts.
  template <class Accumulator, class... Parts>
  __device__ Accumulator sum(const Parts&... parts) const {
    constexpr int others = sizeof...(Parts) - 1;
    // a shared object may not have an initialiser
    __shared__ unsigned memory[others > 0 ? others : 1][32 * detail::words<Accumulator>()];
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

  /// Returns whether the thread is in warp 0, whose team lanes have the total.
  __device__ bool holds_total() const { return warp() == 0; }
  /// Returns whether the thread is team lane 0 of warp 0.
  __device__ bool leader() const { return present_ && warp() == 0 && lane() == 0; }

 private:
  __device__ static int warp() { return static_cast<int>(threadIdx.x) / 32; }

  bool present_;
};

/// A team whose team lanes compute the parts of a sum one after the other (head of this file). `has_rows`: the block's
/// teams have consecutive items.
template <int W, bool has_rows = false>
class SerialLaneTeam : public NeighbourLanes<W> {
  using NeighbourLanes<W>::lane;

 public:
  static_assert(W >= 1 && W <= 32 && (W & (W - 1)) == 0, "W is a power of two, at most 32");
  static constexpr int width = W;  ///< W, team lanes
  static constexpr bool moves_totals = false;

  __device__ explicit SerialLaneTeam(bool present) : present_(present) {}

  /// Waits for the previous launch.
  __device__ static void leave() { cudaGridDependencySynchronize(); }

  /// Fetches rows of a stream into the second-level cache while the team computes. A launch of SerialLaneTeams reads
  /// more than the cache holds.
  __device__ static void prefetch(const void* rows, int bytes) {
    constexpr int line = 128;
    for (int at = line * lane(); at < bytes; at += line * W)
      asm volatile("prefetch.global.L2 [%0];" ::"l"(static_cast<const char*>(rows) + at));
  }

  /// Returns the total. The first part must not be pooled, because its first items are loaded while the previous launch
  /// may still run.
  template <class Accumulator, class First, class... Others>
  __device__ Accumulator sum(const First& first, const Others&... others) const {
    Accumulator total{};
    add<true>(first, total);
    (add<false>(others, total), ...);
    return detail::total_of_lanes<W>(total);
  }

  /// Returns true, because each team lane has the total.
  __device__ static bool holds_total() { return true; }
  __device__ bool leader() const { return present_ && lane() == 0; }

 protected:
  bool present_;

 private:
  template <bool begins, class Load, class Add, class Accumulator>
  __device__ static void add(const Part<Load, Add>& part, Accumulator& total) {
    Accumulator own{};
    detail::add_part<W, begins>(part, lane(), own);
    total += own;
  }
  template <bool begins, class Load, class Term, class Accumulator>
  __device__ void add(const PooledPart<Load, Term>& part, Accumulator& total) const {
    static_assert(!begins, "the first part is not pooled");
    Accumulator own{};
    if constexpr (has_rows)
      detail::add_pooled_rows<W>(part, present_, own);
    else
      detail::add_pooled<W>(part, present_, own);
    total += own;
  }
};

/// A thread that does the work of a vertex after the sum alone.
struct EndThread : OneLane {
  bool has_total, present;  ///< whether it has a total; whether it is the total of an item

  __device__ EndThread(bool total, bool item) : has_total(total), present(item) {}
  __device__ bool holds_total() const { return has_total; }
  __device__ bool leader() const { return present; }
};

/// A SerialLaneTeam whose totals move to the first threads of the block, one for each team. The work after the sum is
/// then done by neighbouring threads, while most warps of the block have ended. In a SerialLaneTeam each warp does it
/// with one lane in W.
template <int W>
class CompactTeam : public SerialLaneTeam<W, true> {
  using SerialLaneTeam<W, true>::present_;

 public:
  static constexpr bool moves_totals = true;

  using SerialLaneTeam<W, true>::SerialLaneTeam;

  /// Moves the total of each team to a thread, and replaces `slot` by the slot of the total's item. All threads of the
  /// block call it together.
  template <class Accumulator>
  __device__ EndThread move_total(Accumulator& total, int& slot) const {
    constexpr int teams = serial_block_size / W;
    __shared__ unsigned memory[teams][detail::words<Accumulator>()];
    __shared__ int slots[teams];
    const int thread = static_cast<int>(threadIdx.x);
    if (thread % W == 0) {
      *reinterpret_cast<Accumulator*>(memory[thread / W]) = total;
      slots[thread / W] = present_ ? slot : ~slot;
    }
    __syncthreads();
    if (thread >= teams) return {false, false};
    total = *reinterpret_cast<const Accumulator*>(memory[thread]);
    slot = slots[thread];
    const bool is_item = slot >= 0;
    if (!is_item) slot = ~slot;
    return {true, is_item};
  }
};

}  // namespace ogc::fast
