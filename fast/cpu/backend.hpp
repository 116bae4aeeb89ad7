// Implements the backend of fast/stages/backend.hpp on the host's threads. Work is done when a call returns, so
// `synchronize` has nothing to wait for. Short loops stay in the calling thread. Several threads may call all functions
// except `replay`.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "fast/cpu/least.hpp"
#include "fast/cpu/pack_kernels.hpp"
#include "fast/cpu/packed_search.hpp"
#include "fast/kernels/search.hpp"
#include "fast/kernels/sweep/sums.hpp"
#include "fast/kernels/sweep/update_vertex.hpp"
#include "fast/kernels/team.hpp"
#include "fast/stages/backend.hpp"
#include "fast/stages/hall.hpp"

namespace ogc::fast {

/// A resident array on the host.
template <class T>
class CpuBuffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  CpuBuffer() = default;
  CpuBuffer(CpuBuffer&&) noexcept = default;
  CpuBuffer& operator=(CpuBuffer&&) noexcept = default;

  /// Returns the items, size() of them; null before the first allocation.
  T* data() { return items_.get(); }
  const T* data() const { return items_.get(); }
  std::size_t size() const { return size_; }

  /// Sets the number of items. Does not keep the content, and never shrinks the memory. New memory is zero.
  void resize(std::size_t n) {
    if (n > capacity_) {
      items_ = std::make_unique<T[]>(n);
      capacity_ = n;
    }
    size_ = n;
  }
  /// Resizes to n and copies.
  void upload(const T* from, std::size_t n) {
    resize(n);
    std::copy_n(from, n, items_.get());
  }
  void download(T* to, std::size_t n) const { std::copy_n(items_.get(), n, to); }
  void fill_zero() {
    if (size_ > 0) std::memset(static_cast<void*>(items_.get()), 0, size_ * sizeof(T));
  }

 private:
  std::unique_ptr<T[]> items_;
  std::size_t size_ = 0, capacity_ = 0;
};

/// Returns the functor that the host runs for a team loop.
template <class F>
F on_packs(const F& f) {
  return f;
}
/// Returns the functor that computes the same sums in packs (fast/cpu/pack.hpp). Only functors that sum stencils of all
/// kinds (GatherAll) have one.
inline UpdateVertex<GatherPacked> on_packs(const UpdateVertex<GatherAll>& f) {
  return {f.view, f.first_slot, f.asks_late};
}
inline MeasureVertex<GatherPacked> on_packs(const MeasureVertex<GatherAll>& f) { return {f.view, f.left, f.is_end}; }

/// Prefetches data that f(i, team) reads and that the processor does not foresee. Does nothing unless F has an
/// overload.
template <class F>
void look_ahead(const F&, int) {}
/// Prefetches a row of contacts.
inline void prefetch(const ContactIncidence* contacts, Row row) {
  constexpr int line = 64;
  const char* begin = reinterpret_cast<const char*>(contacts + row.begin);
  const int bytes = row.count * static_cast<int>(sizeof(ContactIncidence));
  for (int at = 0; at < bytes; at += line) __builtin_prefetch(begin + at);
}
/// Prefetches a vertex's contacts. The processor does not foresee them, because rows have different lengths and two
/// kinds.
template <class Gather>
void look_ahead(const UpdateVertex<Gather>& f, int i) {
  const ContactRow row = f.view.contact_rows[f.first_slot + i];
  prefetch(f.view.contacts, row.vertex_facet), prefetch(f.view.contacts, row.edge_edge);
}

/// Runs a range of a team loop. `flatten`: otherwise GCC may call the solve and the truncation of an update, which took
/// 1.06 of the time.
template <int W, class F>
[[gnu::flatten]] void run_teams(const F& f, int begin, int end) {
  constexpr int ahead = 2;
  for (int i = begin; i < end; ++i) {
    if (i + ahead < end) look_ahead(f, i + ahead);
    f(i, SerialTeam<W>{});
  }
}

/// Runs loops on the threads of oneTBB; fast/stages/backend.hpp describes each member.
class CpuBackend {
 public:
  template <class T>
  using Buffer = CpuBuffer<T>;
  template <class T>
  using Shared = CpuBuffer<T>;
  static constexpr bool has_free_branches = false;
  using Sums = HostSums;

  int device() const { return -1; }

  /// Runs ranges of items as tasks; up to 64 items stay in the calling thread.
  template <class F>
  void for_each(int n, F f) {
    for_each_range(n, [&f](int begin, int end) { run_range(f, begin, end); });
  }

  /// Runs each item in one thread.
  template <int W, class F>
  void for_each_group(int n, F f) {
    for_each(n, f);
  }

  /// Reads the count on the host, because all work enqueued before is done.
  template <class F>
  void for_each_counted(const int* n, int capacity, F f) {
    for_each(std::min(*n, capacity), f);
  }

  /// Runs one loop after the other.
  template <class F, class G>
  void for_both(int m, F f, const int* n, int capacity, G g) {
    for_each(m, f);
    for_each_counted(n, capacity, g);
  }

  /// Runs each team in one thread as SerialTeam<W>, in packs if `on_packs` has such a functor. Start has no effect:
  /// each loop ends before the next begins.
  template <int W, class F>
  void for_each_team(Teams teams, F f, Start) {
    for_each_range(teams.count, [f = on_packs(f)](int begin, int end) { run_teams<W>(f, begin, end); });
  }

  /// Calls f(i, a, b) for each row i of `values`: a is the smallest number, b the number with index F::rank in
  /// ascending order (infinity if there is none). One thread reads a row.
  template <class F>
  void for_each_row(int n, const int* offsets, const float* values, F f) {
    for_each(n, [f, offsets, values](int i) {
      const auto least = least_of_row<F::rank>(values, offsets[i], offsets[i + 1]);
      f(i, least[0], least[F::rank]);
    });
  }

  /// Runs one loop over the searches of both kinds, so that no thread waits between the kinds.
  template <class First, class Second>
  void search(const Searches<First>& first, const Searches<Second>& second) {
    for_each_range(first.count + second.count, [&first, &second](int begin, int end) {
      const int middle = std::clamp(first.count, begin, end);
      packed::run_searches(first, begin, middle);
      packed::run_searches(second, middle - first.count, end - first.count);
    });
  }

  /// Runs both scans in the calling thread.
  void exclusive_scans(const Scan& first, const Scan& second) {
    exclusive_scan(first);
    exclusive_scan(second);
  }

  /// Sorts in parallel. Equal keys keep their order, as in a stable sort.
  void sort_pairs(std::uint64_t* keys, int* values, int n, KeyBits bits = {}) {
    std::vector<Item> items(static_cast<std::size_t>(n));
    for_each(n, [&](int i) { items[static_cast<std::size_t>(i)] = {keys[i], i, values[i]}; });
    const int above = 64 - bits.end;
    const auto part = [bits, above](std::uint64_t key) { return key << above >> (above + bits.begin); };
    tbb::parallel_sort(items.begin(), items.end(), [part](const Item& a, const Item& b) {
      return part(a.key) != part(b.key) ? part(a.key) < part(b.key) : a.number < b.number;
    });
    for_each(n, [&](int i) {
      keys[i] = items[static_cast<std::size_t>(i)].key;
      values[i] = items[static_cast<std::size_t>(i)].value;
    });
  }

  template <class F, class Body>
  void when(F decide, const int* flag, Body body) {
    decide(0);
    if (*flag != 0) body();
  }

  template <class F, class Body, class G>
  void repeat(F decide, const int* flag, Body body, G decide_again) {
    for (decide(0); *flag != 0; decide_again(0)) body();
  }

  /// Runs aside(), then body().
  template <class Aside, class Body>
  void at_once(Aside aside, Body body) {
    aside();
    body();
  }

  /// Nothing is recorded on the host.
  struct Recording {
    void clear() {}
  };

  /// Runs the body `times` times and measures the time of each run. The rest of the repetitions is left out once
  /// *goes_on is 0.
  template <class Body>
  void replay(Recording&, int times, Body body, const int* goes_on = nullptr) {
    for (int k = 0; k < times && (goes_on == nullptr || *goes_on != 0); ++k) {
      const auto start = std::chrono::steady_clock::now();
      body();
      replay_milliseconds_.push_back(
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
  }
  /// Returns the wall time of each repetition since the last call [ms].
  std::vector<double> replay_milliseconds() { return std::exchange(replay_milliseconds_, {}); }

  void synchronize() {}
  void synchronize_device() {}

  const std::uint32_t* meetings() const { return &meetings_; }
  void join(Hall& hall, int) { hall_ = &hall; }
  template <class F, class G>
  void meet(int n, const F& send, const G& end) {
    for_each(n, send);
    hall_->meet();
    end(0);
    ++meetings_;
  }

 private:
  struct Item {
    std::uint64_t key;
    int number, value;
  };

  static void exclusive_scan(const Scan& scan) {
    int total = 0;
    for (int i = 0; i < scan.count; ++i) {
      const int item = scan.in[i];
      scan.out[i] = total;
      total += item;
    }
    scan.out[scan.count] = total;
  }

  /// Calls run(begin, end) for ranges that together cover 0 … n − 1.
  template <class Run>
  static void for_each_range(int n, const Run& run) {
    constexpr int grain = 64;
    if (n <= grain) return run(0, n);
    tbb::parallel_for(tbb::blocked_range<int>(0, n, grain),
                      [&run](const tbb::blocked_range<int>& range) { run(range.begin(), range.end()); });
  }

  std::vector<double> replay_milliseconds_;
  Hall* hall_ = nullptr;  ///< where this backend meets the other parts
  std::uint32_t meetings_ = 0;
};

}  // namespace ogc::fast
