// Implements the backend of fast/stages/backend.hpp on one CUDA device.
//
//   stream_        a blocking stream: Buffer copies (legacy stream) order themselves with it, nothing else waits
//   current_       the stream that takes work: stream_, or the body of a node while `when` or `repeat` records it
//   scratch_       temporary memory that scan and sort share: they run one after the other
//   follows_       whether the last thing enqueued there is a kernel, which the next may follow (fast/cuda/follow.cuh)
//
// A step is thousands of small kernels; enqueued one by one each costs 3.2 µs of host time, inside a CUDA graph 0.5 µs.
// So `replay` records once what a body enqueues into a graph, and launches the graph for each repetition. It records
// again after a Buffer has moved, since a graph holds pointers. In a graph `when` becomes a conditional IF node (4.1 to
// 4.9 µs skipped, 8.5 µs taken, against 0.5 µs for each guarded kernel), `repeat` a WHILE node, `at_once` two branches
// that part and meet. Outside a recording (probes, --profile) flags are read on the host, and branches run one after
// the other. Conditional nodes need a driver of CUDA 12.4; this runtime (13) needs a newer one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <typeinfo>
#include <vector>

#include <cuda_runtime.h>

#include "compare/problem/error.hpp"
#include "fast/contestant.hpp"
#include "fast/cuda/buffer.cuh"
#include "fast/cuda/check.cuh"
#include "fast/cuda/collectives.cuh"
#include "fast/cuda/follow.cuh"
#include "fast/cuda/least.cuh"
#include "fast/cuda/search.cuh"
#include "fast/cuda/team.cuh"
#include "fast/kernels/sweep/sums.hpp"
#include "fast/kernels/sweep/update_vertex.hpp"
#include "fast/stages/backend.hpp"

namespace ogc::fast {

/// Threads of a block; tests take fewer (LaunchShape).
inline constexpr int cuda_block_size = 128;
/// Threads of a launch for each multiprocessor: twice what it can hold at once. That keeps it busy, and a long
/// count-limited loop costs little.
inline constexpr int threads_per_multiprocessor = 2 * 2048;

/// From this number of team lanes on the teams of a launch are SerialLaneTeams (measured: fast/PERFORMANCE.md). Terms
/// and the order of their sums are the same; a build that contracts may contract the two kernels differently.
inline constexpr int serial_lanes_per_multiprocessor = 350;

/// Up to this number of blocks of SerialLaneTeams, which the device holds at once, their warps are strided. If blocks
/// come one after the other anyway, neighbours in one block share more of what they read (measured:
/// fast/PERFORMANCE.md).
inline constexpr int strided_blocks_per_multiprocessor = 5;

/// Returns F::resident_blocks, the blocks of a loop's launch that a multiprocessor shall hold at once: the compiler
/// limits registers accordingly. 0: registers are not limited.
template <class F>
constexpr int resident_blocks() {
  if constexpr (requires { F::resident_blocks; }) return F::resident_blocks;
  return 0;
}

/// Runs f(i) for i < n; a thread takes every k-th item, k the number of threads of the launch.
template <class F>
__global__ void __launch_bounds__(cuda_block_size) run_each(int n, F f) {
  follow_launch();
  const int stride = static_cast<int>(gridDim.x * blockDim.x);
  for (int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x); i < n; i += stride) f(i);
}

/// Requires ahead(i), which reads what f(i) needs and neither this launch nor the one before writes.
template <class F>
concept ReadsAhead = requires(const F& f) {
  f.ahead(0);
};

/// Does the same; the launch before may still run while a thread reads what its first item needs.
template <ReadsAhead F>
__global__ void __launch_bounds__(cuda_block_size) run_each_ahead(int n, F f) {
  const int stride = static_cast<int>(gridDim.x * blockDim.x);
  int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  auto read = f.ahead(min(i, n - 1));
  follow_launch();
  while (i < n) {
    f(i, read);
    i += stride;
    if (i < n) read = f.ahead(i);
  }
}

/// Does the same for i < *n, which the device reads, and no more than `capacity`.
template <class F>
__global__ void __launch_bounds__(cuda_block_size, resident_blocks<F>())
    run_each_counted(const int* n, int capacity, F f) {
  follow_launch();
  const int stride = static_cast<int>(gridDim.x * blockDim.x);
  const int count = min(*n, capacity);
  for (int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x); i < count; i += stride) f(i);
}

/// Runs f(i) for i < m, then g(i) for i < *n and no more than `capacity`; all items are shared out to the threads as
/// one row.
template <class F, class G>
__global__ void __launch_bounds__(cuda_block_size, resident_blocks<G>())
    run_both(int m, F f, const int* n, int capacity, G g) {
  follow_launch();
  const int stride = static_cast<int>(gridDim.x * blockDim.x);
  const int count = min(*n, capacity);
  int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  for (; i < m; i += stride) f(i);
  for (i -= m; i < count; i += stride) g(i);
}

/// Runs f of each row, a warp a row (fast/cuda/least.cuh).
template <class F>
__global__ void __launch_bounds__(cuda_block_size) run_each_row(int n, const int* offsets, const float* values, F f) {
  follow_launch();
  const int warps = static_cast<int>(gridDim.x * blockDim.x) / 32, lane = static_cast<int>(threadIdx.x) % 32;
  for (int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x) / 32; i < n; i += warps) {
    const float own = least_of_row(values + offsets[i], offsets[i + 1] - offsets[i], F::rank);
    const float after = __shfl_sync(0xffffffffu, own, F::rank);
    if (lane == 0) f(i, own, after);
  }
}

/// Runs one thread, which decides what a conditional node does.
template <class F>
__global__ void run_decision(cudaGraphConditionalHandle handle, F decide, const int* flag) {
  follow_launch();
  decide(0);
  cudaGraphSetConditional(handle, *flag != 0 ? 1u : 0u);
}

/// Runs blocks of 32/W teams; a team beyond the last works on the last item and writes nothing.
template <int W, class F>
__global__ void __launch_bounds__(32 * F::parts) run_spread_teams(int n, F f) {
  const int i = static_cast<int>(blockIdx.x) * (32 / W) + static_cast<int>(threadIdx.x) % 32 / W;
  f(min(i, n - 1), SpreadTeam<W>(i < n));
}

/// Does the same with blocks of serial_block_size/W teams. `strided`: teams of a warp are neighbours, warps of a block
/// are far apart, so that items which take long and lie side by side are shared out.
template <int W, class F>
__global__ void __launch_bounds__(serial_block_size) run_serial_teams(int n, F f, bool strided) {
  const int warp = static_cast<int>(threadIdx.x) / 32, block = static_cast<int>(blockIdx.x);
  const int place = strided ? warp * static_cast<int>(gridDim.x) + block : block * (serial_block_size / 32) + warp;
  const int i = place * (32 / W) + static_cast<int>(threadIdx.x) % 32 / W;
  f(min(i, n - 1), SerialLaneTeam<W>(i < n));
}

/// A body recorded as a graph. Empty at first; `CudaBackend::replay` fills and renews it.
class CudaRecording {
 public:
  CudaRecording() = default;
  CudaRecording(const CudaRecording&) = delete;
  CudaRecording& operator=(const CudaRecording&) = delete;
  ~CudaRecording() { clear(); }
  /// Makes the next replay record again, after constants of the body have changed.
  void clear() noexcept;

 private:
  friend class CudaBackend;
  cudaGraphExec_t graph_ = nullptr;
  std::uint64_t generation_ = 0;
};

/// One stream of one device; fast/stages/backend.hpp describes each member.
class CudaBackend {
 public:
  template <class T>
  using Buffer = CudaBuffer<T>;
  using Sums = DeviceSums;
  using Recording = CudaRecording;

  /// Throws compare::ResourceError if there is no usable device, with cuda_info's reason, and compare::InputError if
  /// the threads of `shape` are no multiple of 32 up to cuda_block_size.
  explicit CudaBackend(const LaunchShape& shape = {});
  CudaBackend(CudaBackend&& other) noexcept;
  CudaBackend& operator=(CudaBackend&&) = delete;
  ~CudaBackend();

  /// Launches a thread an item, as far as the device can hold them; a thread of a larger loop takes several.
  template <class F>
  void for_each(int n, F f) {
    if (n <= 0) return;
    if constexpr (ReadsAhead<F>)
      follow(typeid(F), run_each_ahead<F>, blocks(n), block_threads_, n, f);
    else
      follow(typeid(F), run_each<F>, blocks(n), block_threads_, n, f);
  }

  /// Launches room for `capacity` items; the device reads how many there are.
  template <class F>
  void for_each_counted(const int* n, int capacity, F f) {
    if (capacity <= 0) return;
    follow(typeid(F), run_each_counted<F>, blocks(capacity), block_threads_, n, capacity, f);
  }

  /// Runs both as for_each and for_each_counted do, in one launch.
  template <class F, class G>
  void for_both(int m, F f, const int* n, int capacity, G g) {
    if (m <= 0) return for_each_counted(n, capacity, g);
    follow(typeid(G), run_both<F, G>, blocks(std::int64_t{m} + capacity), block_threads_, m, f, n, capacity, g);
  }

  /// Launches a warp a row; a warp of a larger loop takes several.
  template <class F>
  void for_each_row(int n, const int* offsets, const float* values, F f) {
    if (n <= 0) return;
    follow(typeid(F), run_each_row<F>, blocks(std::int64_t{32} * n), block_threads_, n, offsets, values, f);
  }

  /// Runs SpreadTeams if there are few team lanes, SerialLaneTeams if they fill the device. Start::overlapping lets the
  /// launch begin while the one before still runs.
  template <int W, class F>
  void for_each_team(int n, F f, Start start) {
    if (n <= 0) return;
    const bool serial = static_cast<std::int64_t>(n) * W >=
                        std::int64_t{multiprocessors_} * serial_lanes_per_multiprocessor;
    const int teams = (serial ? serial_block_size : 32) / W;  // in a block
    const int blocks = (n + teams - 1) / teams;
    const bool early = start == Start::overlapping;
    if (serial) {
      launch_kernel(current_, early, run_serial_teams<W, F>, blocks, serial_block_size, n, f,
                    blocks <= multiprocessors_ * strided_blocks_per_multiprocessor);
    } else {
      launch_kernel(current_, early, run_spread_teams<W, F>, blocks, 32 * F::parts, n, f);
    }
    check_launch(typeid(F));
    follows_ = true;
  }

  /// Searches in one launch by warps (fast/cuda/search.cuh). Throws compare::ResourceError for a tree of more than
  /// largest_searched_count primitives.
  template <class First, class Second>
  void search(const Searches<First>& first, const Searches<Second>& second) {
    require_searchable(first.tree);
    require_searchable(second.tree);
    const int warps = std::min(search_warps, block_threads_ / 32);
    const SearchGroups first_groups(first.count, search_group(first.count)),
        second_groups(second.count, search_group(second.count));
    const int first_blocks = first_groups.blocks(warps), blocks = first_blocks + second_groups.blocks(warps);
    if (blocks == 0) return;
    follow(typeid(Searches<First>), run_searches<First, Second>, blocks, 32 * warps, first, first_groups, first_blocks,
           second, second_groups);
  }

  /// Scans in one launch if both are short, else in two; may allocate temporary memory.
  void exclusive_scans(const Scan& first, const Scan& second) {
    fast::exclusive_scans(current_, scratch_, recording_ && follows_, first, second);
    follows_ = true;
  }
  /// Sorts by CUB's radix sort; may allocate temporary memory.
  void sort_pairs(std::uint64_t* keys, int* values, int n, KeyBits bits = {}) {
    fast::sort_pairs(current_, scratch_, keys, values, n, bits);
    follows_ = false;  // it may end with a copy
  }

  /// Records a conditional IF node; outside a recording the host waits for the flag.
  template <class F, class Body>
  void when(F decide, const int* flag, Body body) {
    if (!recording_) {
      for_each(1, decide);
      if (read_flag(flag)) body();
      return;
    }
    const cudaGraphConditionalHandle handle = new_condition();
    set_condition(handle, decide, flag);
    const cudaStream_t outer = begin_condition(handle, cudaGraphCondTypeIf);
    body();
    end_condition(outer);
  }

  /// Records a conditional WHILE node; outside a recording the host waits for the flag before each round.
  template <class F, class Body, class G>
  void repeat(F decide, const int* flag, Body body, G decide_again) {
    if (!recording_) {
      for (for_each(1, decide); read_flag(flag); for_each(1, decide_again)) body();
      return;
    }
    const cudaGraphConditionalHandle handle = new_condition();
    set_condition(handle, decide, flag);
    const cudaStream_t outer = begin_condition(handle, cudaGraphCondTypeWhile);
    body();
    set_condition(handle, decide_again, flag);
    end_condition(outer);
  }

  /// Records two branches of the graph; outside a recording runs one after the other.
  template <class Aside, class Body>
  void at_once(Aside aside, Body body) {
    if (!recording_) {
      aside();
      body();
      return;
    }
    const cudaStream_t main = begin_branch(), branch = current_;
    try {
      aside();
    } catch (...) {
      end_branch(main);
      throw;
    }
    end_branch(main);
    body();
    join(branch);
  }

  /// Enqueues what `body` enqueues, `times` times over. `body` runs on the host only if `recording` is empty or stale,
  /// so it must enqueue the same calls with the same arguments every time; what changes from step to step (numbers,
  /// targets) is counted on the device.
  template <class Body>
  void replay(Recording& recording, int times, Body body) {
    if (recording.graph_ == nullptr || recording.generation_ != buffer_generation) {
      recording.clear();
      begin_recording();
      try {
        body();
      } catch (...) {
        abandon_recording();
        throw;
      }
      end_recording(recording);
    }
    launch(recording, times);
  }

  /// Returns the device time of each repetition since the last call [ms]. Host only, after synchronize.
  std::vector<double> replay_milliseconds();

  /// Waits for all that was enqueued. Throws if one of its kernels has failed.
  void synchronize() { OGC_CUDA_CHECK(cudaStreamSynchronize(stream_)); }

 private:
  int blocks(std::int64_t threads) const {
    const std::int64_t most = std::int64_t{multiprocessors_} * threads_per_multiprocessor / block_threads_;
    return static_cast<int>(std::min<std::int64_t>((threads + block_threads_ - 1) / block_threads_, most));
  }
  static void require_searchable(const TreeView& tree) {
    if (tree.count > largest_searched_count)
      throw compare::ResourceError("a mesh of more than 134 million edges or triangles needs --backend cpu");
  }
  /// Returns the searches of a warp: few until the device is full (32 warps a multiprocessor), so that each warp is
  /// short; more spare it rounds that do not fill a warp.
  int search_group(int searches) const {
    const std::int64_t warps = std::int64_t{multiprocessors_} * 32;
    return static_cast<int>(std::clamp<std::int64_t>((searches + warps - 1) / warps, 1, largest_group));
  }
  static void check_launch(const std::type_info& functor) {
    const cudaError_t error = cudaGetLastError();
    if (error != cudaSuccess)
      throw_cuda_error(error, ("the launch of " + readable_type(functor.name())).c_str(), __FILE__, __LINE__);
  }
  /// Launches a kernel that begins with follow_launch. It overlaps only in a recording: elsewhere copies may stand
  /// between two launches.
  template <class Kernel, class... Arguments>
  void follow(const std::type_info& functor, Kernel kernel, int blocks, int threads, const Arguments&... arguments) {
    launch_kernel(current_, recording_ && follows_, kernel, blocks, threads, arguments...);
    check_launch(functor);
    follows_ = true;
  }
  bool read_flag(const int* flag);
  cudaGraphConditionalHandle new_condition();
  template <class F>
  void set_condition(cudaGraphConditionalHandle handle, F decide, const int* flag) {
    follow(typeid(F), run_decision<F>, 1, 1, handle, decide, flag);
  }
  cudaStream_t begin_condition(cudaGraphConditionalHandle handle, cudaGraphConditionalNodeType type);
  void end_condition(cudaStream_t outer);
  cudaStream_t begin_branch();
  void end_branch(cudaStream_t main);
  void join(cudaStream_t branch);
  void wait_for(cudaStream_t waiting, cudaStream_t other);
  void end_branches() noexcept;
  void begin_recording();
  void end_recording(Recording& recording);
  void abandon_recording() noexcept;
  void launch(const Recording& recording, int times);

  cudaStream_t stream_ = nullptr, current_ = nullptr;
  bool recording_ = false, follows_ = false;
  int block_threads_ = cuda_block_size, multiprocessors_ = 1;
  Scratch scratch_;
  std::vector<cudaStream_t> branches_;  // of the recording under way
  std::vector<cudaEvent_t> crossings_;  // of the recording under way: where branches part and meet
  std::vector<cudaEvent_t> events_;     // in the order of time; between two of them lies a repetition, or nothing
  std::vector<bool> is_end_;            // by event since the last replay_milliseconds: whether it ends a repetition
};

}  // namespace ogc::fast
