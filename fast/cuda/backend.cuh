// Implements the backend of fast/stages/backend.hpp on one CUDA device.
//
//   stream_        a blocking stream: ordered with Buffer copies (legacy stream); nothing else waits
//   current_       the stream that takes work: stream_, or another one while a node's body or a branch is recorded
//   scratch_       temporary memory that scan and sort share, since they run one after the other; branches have memory
//                  of their own
//   follows_       whether the last work in current_ is a kernel, which the next one may follow (fast/cuda/follow.cuh)
//
// A step has thousands of small kernels. Enqueued one by one each costs 3.2 µs of host time; inside a CUDA graph it
// costs 0.5 µs. So `replay` records the body's work once in a graph and launches the graph for each repetition. It
// records again after a Buffer has moved, since a graph holds pointers.
//
// In a graph `when` becomes a conditional IF node (skipped 4.1 to 4.9 µs, taken 8.5 µs; a guarded kernel costs 0.5 µs),
// `repeat` a WHILE node, and `at_once` two branches. Outside a recording (probes, --profile) flags are read on the
// host, and branches run one after the other. Conditional nodes need a driver of CUDA 12.4; this runtime (13) needs a
// newer one.
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
#include "fast/cuda/meeting.cuh"
#include "fast/cuda/search.cuh"
#include "fast/cuda/team.cuh"
#include "fast/kernels/sweep/sums.hpp"
#include "fast/kernels/sweep/update_vertex.hpp"
#include "fast/stages/backend.hpp"
#include "fast/stages/hall.hpp"
#include "fast/stages/team_choice.hpp"

namespace ogc::fast {

/// Threads of a block. Tests use fewer (LaunchShape).
inline constexpr int cuda_block_size = 128;
/// Threads of a launch for each multiprocessor: twice as many as run at once, which keeps the multiprocessor busy.
/// Loops over a counted number of items cost little even if the capacity is large.
inline constexpr int threads_per_multiprocessor = 2 * 2048;

/// If a launch has at least this number of team lanes for each multiprocessor, its teams are SerialLaneTeams (measured:
/// fast/PERFORMANCE.md). Both kinds of teams have the same terms and the same order of sums. If the compiler contracts
/// operations, it may do so differently in the two kernels.
inline constexpr int serial_lanes_per_multiprocessor = 350;

/// If a launch has at most this number of blocks of SerialLaneTeams for each multiprocessor, all blocks run at once and
/// warps are strided (see run_serial_teams). Blocks of larger launches run one after the other anyway, and neighbours
/// in one block share more of their reads (measured: fast/PERFORMANCE.md).
inline constexpr int strided_blocks_per_multiprocessor = 5;

/// Returns F::resident_blocks, the number of blocks that a multiprocessor should run at once; the compiler limits
/// registers accordingly. 0: registers are not limited.
template <class F>
constexpr int resident_blocks() {
  if constexpr (requires { F::resident_blocks; }) return F::resident_blocks;
  return 0;
}

/// Runs f(i) for i < n. A thread takes every k-th item, with k threads in the launch.
template <class F>
__global__ void __launch_bounds__(cuda_block_size) run_each(int n, F f) {
  follow_launch();
  const int stride = static_cast<int>(gridDim.x * blockDim.x);
  for (int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x); i < n; i += stride) f(i);
}

/// Requires ahead(i): it reads data of f(i) that neither this launch nor the previous one writes.
template <class F>
concept ReadsAhead = requires(const F& f) {
  f.ahead(0);
};

/// Requires load(i): it reads data of f(i) that this launch does not write. So a thread reads data of its next item
/// before it works on an item, and the two reads overlap.
template <class F>
concept LoadsNext = requires(const F& f) {
  f.load(0);
};

/// Runs f(i) for i < n. A thread reads ahead for its first item while the previous launch may still run.
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

/// Runs f(i) for i < min(*n, capacity). The device reads *n.
template <class F>
__global__ void __launch_bounds__(cuda_block_size, resident_blocks<F>())
    run_each_counted(const int* n, int capacity, F f) {
  follow_launch();
  const int stride = static_cast<int>(gridDim.x * blockDim.x);
  const int count = min(*n, capacity);
  for (int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x); i < count; i += stride) f(i);
}

/// Runs f(i) for i < m, and g(i) for i < min(*n, capacity). The threads of the launch share the items of both loops.
template <class F, class G>
__global__ void __launch_bounds__(cuda_block_size, resident_blocks<G>())
    run_both(int m, F f, const int* n, int capacity, G g) {
  follow_launch();
  const int stride = static_cast<int>(gridDim.x * blockDim.x);
  const int count = min(*n, capacity);
  int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  for (; i < m; i += stride) f(i);
  i -= m;
  if constexpr (LoadsNext<G>) {
    decltype(g.load(0)) loaded{};
    if (i < count) loaded = g.load(i);
    while (i < count) {
      const auto own = loaded;
      const int next = i + stride;
      if (next < count) loaded = g.load(next);
      g(i, own);
      i = next;
    }
  } else {
    for (; i < count; i += stride) g(i);
  }
}

/// Runs f(i, lanes) for i < n, with W neighbouring threads for each i.
template <int W, class F>
__global__ void __launch_bounds__(cuda_block_size) run_each_group(int n, F f) {
  follow_launch();
  const int groups = static_cast<int>(gridDim.x * blockDim.x) / W;
  for (int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x) / W; i < n; i += groups) f(i, GroupLanes<W>{});
}

/// Runs f for each row, with one warp per row (fast/cuda/least.cuh).
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

/// Runs one thread that decides whether a conditional node runs its body.
template <class F>
__global__ void run_decision(cudaGraphConditionalHandle handle, F decide, const int* flag) {
  follow_launch();
  decide(0);
  cudaGraphSetConditional(handle, *flag != 0 ? 1u : 0u);
}

/// Returns the number of blocks of SpreadTeams that a multiprocessor should run at once. With six parts, registers
/// would allow three blocks; four need no second wave in garments (measured: fast/PERFORMANCE.md). 0: no limit.
constexpr int spread_blocks(int parts) { return parts == 6 ? 4 : 0; }

/// Runs blocks of 32/W teams. Teams beyond the last item compute the last item and write nothing.
template <int W, class F>
__global__ void __launch_bounds__(32 * F::parts, spread_blocks(F::parts)) run_spread_teams(int n, F f) {
  const int i = static_cast<int>(blockIdx.x) * (32 / W) + static_cast<int>(threadIdx.x) % 32 / W;
  f(min(i, n - 1), SpreadTeam<W>(i < n));
}

/// Runs blocks of serial_block_size/W teams. `strided`: the teams of a warp are neighbours, but the warps of a block
/// are far apart. So slow items that are neighbours are spread over several blocks.
template <int W, class F>
__global__ void __launch_bounds__(serial_block_size) run_serial_teams(int n, F f, bool strided) {
  const int warp = static_cast<int>(threadIdx.x) / 32, block = static_cast<int>(blockIdx.x);
  const int place = strided ? warp * static_cast<int>(gridDim.x) + block : block * (serial_block_size / 32) + warp;
  const int i = place * (32 / W) + static_cast<int>(threadIdx.x) % 32 / W;
  f(min(i, n - 1), SerialLaneTeam<W>(i < n));
}

/// Returns whether large launches of F run CompactTeams of this width. Only updates of vertices may (can_be_compact).
template <int W, class F>
constexpr bool has_compact_teams() {
  if constexpr (requires(const F& f) { f.shares_end(); }) return can_be_compact(W, F::parts);
  return false;
}

/// Runs blocks of serial_block_size/W CompactTeams.
template <int W, class F>
__global__ void __launch_bounds__(serial_block_size, compact_blocks) run_compact_teams(int n, F f) {
  const int i = (static_cast<int>(blockIdx.x) * serial_block_size + static_cast<int>(threadIdx.x)) / W;
  f(min(i, n - 1), CompactTeam<W>(i < n));
}

/// A body recorded as a graph, empty at first. `CudaBackend::replay` records it, and records again if it is stale.
class CudaRecording {
 public:
  CudaRecording() = default;
  CudaRecording(const CudaRecording&) = delete;
  CudaRecording& operator=(const CudaRecording&) = delete;
  ~CudaRecording() { clear(); }
  /// Makes the next replay record again; needed after constants of the body have changed.
  void clear() noexcept;

 private:
  friend class CudaBackend;
  cudaGraphExec_t graph_ = nullptr;
  std::uint64_t generation_ = 0;
};

/// Runs work in order on one device; fast/stages/backend.hpp describes each member.
class CudaBackend {
 public:
  template <class T>
  using Buffer = CudaBuffer<T>;
  template <class T>
  using Shared = CudaBuffer<T>;
  static constexpr bool has_free_branches = false;
  using Sums = DeviceSums;
  using Recording = CudaRecording;

  /// Throws compare::ResourceError with the reason of cuda_info if there is no usable device. Throws
  /// compare::InputError if `shape` has a number of threads that is not a multiple of 32 up to cuda_block_size.
  explicit CudaBackend(const LaunchShape& shape = {});
  CudaBackend(CudaBackend&& other) noexcept;
  CudaBackend& operator=(CudaBackend&&) = delete;
  ~CudaBackend();

  int device() const { return device_; }

  /// Launches one thread per item. If the device cannot hold so many threads, a thread takes several items.
  template <class F>
  void for_each(int n, F f) {
    if (n <= 0) return;
    if constexpr (ReadsAhead<F>)
      follow(typeid(F), run_each_ahead<F>, blocks(n), block_threads_, n, f);
    else
      follow(typeid(F), run_each<F>, blocks(n), block_threads_, n, f);
  }

  /// Launches W threads per item, which share its work. If the device cannot hold so many threads, they take several
  /// items.
  template <int W, class F>
  void for_each_group(int n, F f) {
    if (n <= 0) return;
    follow(typeid(F), run_each_group<W, F>, blocks(std::int64_t{W} * n), block_threads_, n, f);
  }

  /// Launches threads for `capacity` items; the device reads the number of items.
  template <class F>
  void for_each_counted(const int* n, int capacity, F f) {
    if (capacity <= 0) return;
    follow(typeid(F), run_each_counted<F>, blocks(capacity), block_threads_, n, capacity, f);
  }

  /// Runs the loops of for_each and for_each_counted in one launch.
  template <class F, class G>
  void for_both(int m, F f, const int* n, int capacity, G g) {
    if (m <= 0) return for_each_counted(n, capacity, g);
    follow(typeid(G), run_both<F, G>, blocks(std::int64_t{m} + capacity), block_threads_, m, f, n, capacity, g);
  }

  /// Launches one warp per row. If the device cannot hold so many warps, a warp takes several rows.
  template <class F>
  void for_each_row(int n, const int* offsets, const float* values, F f) {
    if (n <= 0) return;
    follow(typeid(F), run_each_row<F>, blocks(std::int64_t{32} * n), block_threads_, n, offsets, values, f);
  }

  /// Runs SpreadTeams if there are few team lanes, SerialLaneTeams if team lanes fill the device, and CompactTeams if
  /// they fill it several times. With
  /// Start::overlapping the launch may begin while the previous one still runs.
  template <int W, class F>
  void for_each_team(Teams teams, F f, Start start) {
    const int n = teams.count;
    if (n <= 0) return;
    // The kind of team depends on the whole launch: kernels of two kinds may round differently (see above).
    const bool serial = static_cast<std::int64_t>(teams.whole) * W >=
                        std::int64_t{multiprocessors_} * serial_lanes_per_multiprocessor;
    const int in_block = (serial ? serial_block_size : 32) / W;
    const int blocks = (n + in_block - 1) / in_block, of_whole = (teams.whole + in_block - 1) / in_block;
    const bool early = start == Start::overlapping;
    if (!serial) {
      launch_kernel(current_, early, run_spread_teams<W, F>, blocks, 32 * F::parts, n, f);
    } else if (!launch_compact<W>(n, f, blocks, of_whole, early)) {
      launch_kernel(current_, early, run_serial_teams<W, F>, blocks, serial_block_size, n, f,
                    blocks <= multiprocessors_ * strided_blocks_per_multiprocessor);
    }
    check_launch(typeid(F));
    follows_ = true;
  }

  /// Runs both kinds of searches in one launch, by warps (fast/cuda/search.cuh). Throws compare::ResourceError for a
  /// tree of more than largest_searched_count primitives.
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

  /// Runs both scans in one launch if both are short, else in two. May allocate temporary memory.
  void exclusive_scans(const Scan& first, const Scan& second) {
    fast::exclusive_scans(current_, in_branch_ ? branch_scratch_ : scratch_, recording_ && follows_, first, second);
    follows_ = true;
  }
  /// Sorts by CUB's radix sort; may allocate temporary memory.
  void sort_pairs(std::uint64_t* keys, int* values, int n, KeyBits bits = {}) {
    fast::sort_pairs(current_, scratch_, keys, values, n, bits);
    follows_ = false;  // it may end with a copy
  }

  /// Records a conditional IF node. Outside a recording the host waits for the flag.
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

  /// Records a conditional WHILE node. Outside a recording the host waits for the flag before each round.
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

  /// Records two branches of the graph. Outside a recording they run one after the other.
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

  /// Runs the body's work `times` times. `body` runs on the host only if `recording` is empty or stale, so it must
  /// enqueue the same calls with the same arguments every time. The device itself counts the steps, and so finds what
  /// changes from step to step, such as targets.
  template <class Body>
  void replay(Recording& recording, int times, Body body, const int* = nullptr) {
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

  const std::uint32_t* meetings() const { return meetings_.data(); }
  /// Lets this device write into the memory of the other parts' devices. Throws compare::ResourceError if it cannot.
  void join(Hall& hall, int own);
  /// Waits on the device, outside a recording on the host (fast/cuda/meeting.cuh).
  template <class F, class G>
  void meet(int n, const F& send, const G& end) {
    if (!recording_) {
      for_each(n, send);
      synchronize();
      hall_->meet();
      return for_each(1, EndMeeting<G>{end, meetings_.data()});
    }
    const MeetingPlace place{own_part_,        static_cast<int>(flags_.size()),
                             meetings_.data(), done_.data(),
                             flags_.data(),    others_flags_.data()};
    follow(typeid(F), run_meeting<F, G>, std::max(1, blocks(n)), block_threads_, place, n, send, end);
  }

  /// Returns the device time of each repetition since the last call [ms]. Host only, after synchronize.
  std::vector<double> replay_milliseconds();

  /// Waits for all enqueued work. Throws if one of its kernels has failed.
  void synchronize() { OGC_CUDA_CHECK(cudaStreamSynchronize(stream_)); }
  /// Waits for all work on the device, also of other libraries' streams.
  void synchronize_device() { OGC_CUDA_CHECK(cudaDeviceSynchronize()); }

 private:
  /// Launches CompactTeams if F has them, the launch has more than two waves of blocks, and one thread can do the work
  /// after the sum. Returns whether it did.
  template <int W, class F>
  bool launch_compact(int n, const F& f, int blocks, int of_whole, bool early) {
    if constexpr (has_compact_teams<W, F>()) {
      if (f.shares_end() || !has_waves_of_compact(of_whole, multiprocessors_)) return false;
      launch_kernel(current_, early, run_compact_teams<W, F>, blocks, serial_block_size, n, f);
      return true;
    }
    return false;
  }
  int blocks(std::int64_t threads) const {
    const std::int64_t most = std::int64_t{multiprocessors_} * threads_per_multiprocessor / block_threads_;
    return static_cast<int>(std::min<std::int64_t>((threads + block_threads_ - 1) / block_threads_, most));
  }
  static void require_searchable(const TreeView& tree) {
    if (tree.count > largest_searched_count)
      throw compare::ResourceError("a mesh of more than 134 million edges or triangles needs the backend cpu");
  }
  /// Returns the number of searches of a warp. If there are too few searches to fill the device with 32 warps per
  /// multiprocessor, a warp gets one search. With more searches, a warp gets several and has fewer rounds in which
  /// lanes are idle.
  int search_group(int searches) const {
    const std::int64_t warps = std::int64_t{multiprocessors_} * 32;
    return static_cast<int>(std::clamp<std::int64_t>((searches + warps - 1) / warps, 1, largest_group));
  }
  static void check_launch(const std::type_info& functor) {
    const cudaError_t error = cudaGetLastError();
    if (error != cudaSuccess)
      throw_cuda_error(error, ("the launch of " + readable_type(functor.name())).c_str(), __FILE__, __LINE__);
  }
  /// Launches a kernel that begins with follow_launch. The kernel overlaps the previous one only in a recording;
  /// otherwise a copy may be between them.
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
  bool recording_ = false, follows_ = false, in_branch_ = false;
  int device_ = 0, block_threads_ = cuda_block_size, multiprocessors_ = 1;
  Scratch scratch_, branch_scratch_;
  Hall* hall_ = nullptr;  // where this part meets the others on the host; null: there are none
  int own_part_ = 0;
  CudaBuffer<std::uint32_t> meetings_, flags_;
  CudaBuffer<unsigned> done_;
  CudaBuffer<std::uint32_t*> others_flags_;
  std::vector<cudaStream_t> branches_;  // of the current recording
  std::vector<cudaEvent_t> crossings_;  // of the current recording: events where branches begin and end
  std::vector<cudaEvent_t> events_;     // in the order of time; two consecutive events enclose a repetition, or nothing
  std::vector<bool> is_end_;            // by event since the last replay_milliseconds: whether a repetition ends there
};

}  // namespace ogc::fast
