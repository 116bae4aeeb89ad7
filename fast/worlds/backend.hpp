// Implements the backend of fast/stages/backend.hpp for worlds that run side by side. A call is not run but recorded:
// each world has a program and data of its own. Place::run (fast/worlds/host.hpp, fast/cuda/world_place.cuh) then runs
// the programs of all worlds in one launch, one block a world. A block runs the calls one after the other, reads the
// world's own flags at `when` and `repeat`, and waits for no other world. So worlds may differ in everything, and a
// world computes the same bits beside any others.
//
// A Place supplies memory and blocks:
//   Data, Shared         memories for Pool: of the blocks; of blocks and host, without copies
//   Sums                 the sums of the sweep that are compiled (fast/kernels/sweep/sums.hpp)
//   code<Operation>()    returns the code of an operation
//   run(jobs)            runs the jobs of some worlds; returns the time [ms]
//   device(), synchronize()   device and synchronize_device of the backend
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "fast/worlds/operations.hpp"
#include "fast/worlds/pool.hpp"
#include "fast/worlds/program.hpp"

namespace ogc::fast {

/// Returns the pool that all worlds of a place share.
template <class Memory>
Pool<Memory>& pool_of() {
  static Pool<Memory> pool;
  return pool;
}

/// A resident array of a world; see Buffer in fast/stages/backend.hpp.
template <class Place, class Memory, class T>
class WorldBuffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  WorldBuffer() = default;
  WorldBuffer(WorldBuffer&& other) noexcept { swap(other); }
  WorldBuffer& operator=(WorldBuffer&& other) noexcept {
    swap(other);
    return *this;
  }
  ~WorldBuffer() { pool_of<Memory>().give(items_, capacity_ * sizeof(T)); }

  T* data() { return items_; }
  const T* data() const { return items_; }
  std::size_t size() const { return size_; }

  void resize(std::size_t n) {
    if (n > capacity_) {
      pool_of<Memory>().give(std::exchange(items_, nullptr), std::exchange(capacity_, 0) * sizeof(T));
      items_ = static_cast<T*>(pool_of<Memory>().take(n * sizeof(T)));
      capacity_ = n;
    }
    size_ = n;
  }
  void upload(const T* from, std::size_t n) {
    resize(n);
    if (n > 0) Memory::copy_in(items_, from, n * sizeof(T));
  }
  void download(T* to, std::size_t n) const {
    if (n > 0) Memory::copy_out(to, items_, n * sizeof(T));
  }
  void fill_zero() {
    if (size_ > 0) Memory::fill_zero(items_, size_ * sizeof(T));
  }

 private:
  void swap(WorldBuffer& other) noexcept {
    std::swap(items_, other.items_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }
  T* items_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

/// Records the calls of one world.
template <class Place>
class WorldBackend {
 public:
  template <class T>
  using Buffer = WorldBuffer<Place, typename Place::Data, T>;
  template <class T>
  using Shared = WorldBuffer<Place, typename Place::Shared, T>;
  using Sums = typename Place::Sums;
  /// A block reads a flag without leaving its launch.
  static constexpr bool has_free_branches = true;
  static constexpr bool shares_launches = true;  ///< a world has no launch of its own

  template <class F>
  void for_each(int n, F f) {
    if (n > 0) call(EachOperation<F>{n, f});
  }
  template <int W, class F>
  void for_each_group(int n, F f) {
    if (n > 0) call(GroupOperation<W, F>{n, f});
  }
  template <class F>
  void for_each_counted(const int* n, int capacity, F f) {
    if (capacity > 0) call(CountedOperation<F>{n, capacity, f});
  }
  template <class F, class G>
  void for_both(int m, F f, const int* n, int capacity, G g) {
    call(BothOperation<F, G>{m, n, capacity, f, g});
  }
  template <int W, class F>
  void for_each_team(Teams teams, F f, Start) {
    if (teams.count > 0) call(TeamOperation<W, F>{teams.count, f});
  }
  template <class F>
  void for_each_row(int n, const int* offsets, const float* values, F f) {
    if (n > 0) call(RowOperation<F>{n, offsets, values, f});
  }
  template <class First, class Second>
  void search(const Searches<First>& first, const Searches<Second>& second) {
    call(SearchOperation<First>{first});
    call(SearchOperation<Second>{second});
  }
  void exclusive_scans(const Scan& first, const Scan& second) { call(ScanOperation{first, second}); }
  void sort_pairs(std::uint64_t* keys, int* values, int n, KeyBits bits = {}) {
    if (n < 2) return;
    other_keys_.resize(static_cast<std::size_t>(n));
    other_values_.resize(static_cast<std::size_t>(n));
    call(SortOperation{keys, other_keys_.data(), values, other_values_.data(), n, bits});
  }

  template <class F, class Body>
  void when(F decide, const int* flag, Body body) {
    for_each(1, decide);
    const std::size_t skip = writer_.jump(Instruction::Kind::go_unless, flag);
    body();
    writer_.aim(skip, writer_.size());
  }
  template <class F, class Body, class G>
  void repeat(F decide, const int* flag, Body body, G decide_again) {
    for_each(1, decide);
    const std::size_t skip = writer_.jump(Instruction::Kind::go_unless, flag), begin = writer_.size();
    body();
    for_each(1, decide_again);
    writer_.aim(writer_.jump(Instruction::Kind::go_if, flag), begin);
    writer_.aim(skip, writer_.size());
  }
  template <class Aside, class Body>
  void at_once(Aside aside, Body body) {
    aside();
    body();
  }

  /// The program of a body. Whoever makes a buffer of the body move must clear it.
  class Recording {
   public:
    void clear() { size_ = 0; }

   private:
    friend class WorldBackend;
    Buffer<std::byte> program_;
    int size_ = 0;  ///< [B]; 0: not recorded
  };
  /// Records the body's program unless `recording` has it, and enqueues it `times` times; the rest of the repetitions
  /// is left out once *goes_on is 0.
  template <class Body>
  void replay(Recording& recording, int times, Body body, const int* goes_on = nullptr) {
    close();
    if (recording.size_ == 0) {
      body();
      const std::vector<std::byte>& bytes = writer_.bytes();
      recording.program_.upload(bytes.data(), bytes.size());
      recording.size_ = static_cast<int>(bytes.size());
      writer_.clear();
    }
    segments_.push_back({recording.program_.data(), recording.size_, times, goes_on});
    repetitions_ += times;
  }
  /// Returns for each repetition since the last call the time of its launch, divided by the launch's repetitions of a
  /// world [ms].
  std::vector<double> replay_milliseconds() {
    return std::vector<double>(static_cast<std::size_t>(std::exchange(repetitions_, 0)), milliseconds_);
  }

  int device() const { return Place::device(); }
  void synchronize_device() { Place::synchronize(); }
  /// Runs what is enqueued, for this world alone.
  void synchronize() {
    WorldBackend* const self[] = {this};
    run_worlds<Place>(self, 1);
  }
  /// Returns whether anything is enqueued.
  bool is_pending() const { return !segments_.empty() || !writer_.is_empty(); }

  template <class AnyPlace>
  friend void run_worlds(WorldBackend<AnyPlace>* const* worlds, std::size_t count);

 private:
  template <class Operation>
  void call(const Operation& operation) {
    writer_.call(Place::template code<Operation>(), operation);
  }
  /// Makes the calls that were recorded outside of a replay a segment, whose program is part of the next launch.
  void close() {
    if (writer_.is_empty()) return;
    const std::vector<std::byte>& bytes = writer_.bytes();
    segments_.push_back({nullptr, static_cast<int>(bytes.size()), 1, nullptr});
    loose_.insert(loose_.end(), bytes.begin(), bytes.end());
    writer_.clear();
  }

  ProgramWriter writer_;
  std::vector<Segment> segments_;  ///< enqueued; a null program is the next part of `loose_`
  std::vector<std::byte> loose_;
  Buffer<std::byte> launch_;  ///< what a launch reads whose first world this is
  Buffer<std::uint64_t> other_keys_;
  Buffer<int> other_values_;
  int repetitions_ = 0;
  double milliseconds_ = 0;
};

/// Runs what is enqueued in all of these worlds, in one launch.
template <class Place>
void run_worlds(WorldBackend<Place>* const* worlds, std::size_t count) {
  std::vector<WorldBackend<Place>*> busy;
  std::size_t segments = 0, loose = 0;
  int longest = 0;
  for (std::size_t w = 0; w < count; ++w) {
    if (!worlds[w]->is_pending()) continue;
    worlds[w]->close();
    busy.push_back(worlds[w]);
    segments += worlds[w]->segments_.size();
    loose += worlds[w]->loose_.size();
    longest = std::max(longest, worlds[w]->repetitions_);
  }
  if (busy.empty()) return;
  // One block of memory, which blocks read without a copy: jobs, then segments, then loose programs.
  const auto aligned = [](std::size_t n) {
    return (n + instruction_alignment - 1) / instruction_alignment * instruction_alignment;
  };
  const std::size_t segments_at = aligned(busy.size() * sizeof(WorldJob)),
                    loose_at = segments_at + aligned(segments * sizeof(Segment));
  auto& device = busy.front()->launch_;
  std::vector<std::byte> bytes(loose_at + loose);
  device.resize(std::max(bytes.size(), device.size()));
  std::size_t segment = 0, next = loose_at;
  for (std::size_t w = 0; w < busy.size(); ++w) {
    WorldBackend<Place>& world = *busy[w];
    const WorldJob job{reinterpret_cast<const Segment*>(device.data() + segments_at) + segment,
                       static_cast<int>(world.segments_.size())};
    std::memcpy(bytes.data() + w * sizeof(WorldJob), &job, sizeof(job));
    if (!world.loose_.empty()) std::memcpy(bytes.data() + next, world.loose_.data(), world.loose_.size());
    for (Segment part : world.segments_) {
      if (part.program == nullptr) {
        part.program = device.data() + next;
        next += static_cast<std::size_t>(part.size);
      }
      std::memcpy(bytes.data() + segments_at + segment++ * sizeof(Segment), &part, sizeof(part));
    }
    world.segments_.clear();
    world.loose_.clear();
  }
  Place::Data::copy_in(device.data(), bytes.data(), bytes.size());
  const double milliseconds = Place::run(reinterpret_cast<const WorldJob*>(device.data()),
                                         static_cast<int>(busy.size()));
  for (WorldBackend<Place>* world : busy) world->milliseconds_ = longest > 0 ? milliseconds / longest : 0;
}

}  // namespace ogc::fast
