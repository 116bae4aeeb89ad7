// Each thread writes only its own counters. The lock is taken only when a thread starts or ends and when the sum is
// computed. The list of counters is never destroyed, so that it outlives all threads.
#include "reference/geometry/filter_counts.hpp"

#include <atomic>
#include <mutex>
#include <vector>

namespace ogc::reference {
namespace {

class OwnCounters;

struct Everybody {
  std::mutex mutex;
  std::vector<const OwnCounters*> running;
  FilterCounts ended;
};

Everybody& everybody() {
  static auto* const all = new Everybody;
  return *all;
}

class OwnCounters {
 public:
  OwnCounters() {
    const std::lock_guard lock(everybody().mutex);
    everybody().running.push_back(this);
  }
  ~OwnCounters() {
    const std::lock_guard lock(everybody().mutex);
    std::erase(everybody().running, this);
    add_to(everybody().ended);
  }
  OwnCounters(const OwnCounters&) = delete;
  OwnCounters& operator=(const OwnCounters&) = delete;

  void count(Filtered predicate, bool undecided) {
    const auto k = static_cast<std::size_t>(predicate);
    increment(calls_[k]);
    if (undecided) increment(undecided_[k]);
  }
  void add_to(FilterCounts& sum) const {
    for (std::size_t k = 0; k < filtered_predicates; ++k) {
      sum.of[k].calls += calls_[k].load(std::memory_order_relaxed);
      sum.of[k].undecided += undecided_[k].load(std::memory_order_relaxed);
    }
  }

 private:
  using Counter = std::atomic<std::uint64_t>;
  /// Adds one without an atomic read-modify-write, because only the owner writes.
  static void increment(Counter& counter) {
    counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }

  std::array<Counter, filtered_predicates> calls_{}, undecided_{};
};

}  // namespace

std::string_view name(Filtered predicate) {
  constexpr std::array<std::string_view, filtered_predicates> names{
      "along",    "side",      "turn",      "parallel",       "gap_points",
      "gap_line", "gap_plane", "gap_lines", "distance_below", "nearer"};
  return names[static_cast<std::size_t>(predicate)];
}

FilterCount FilterCounts::total() const {
  FilterCount sum;
  for (const FilterCount& count : of) sum = {sum.calls + count.calls, sum.undecided + count.undecided};
  return sum;
}

FilterCounts FilterCounts::since(const FilterCounts& earlier) const {
  FilterCounts difference;
  for (std::size_t k = 0; k < filtered_predicates; ++k)
    difference.of[k] = {of[k].calls - earlier.of[k].calls, of[k].undecided - earlier.of[k].undecided};
  return difference;
}

FilterCounts filter_counts() {
  const std::lock_guard lock(everybody().mutex);
  FilterCounts sum = everybody().ended;
  for (const OwnCounters* counters : everybody().running) counters->add_to(sum);
  return sum;
}

void count_filter(Filtered predicate, bool undecided) {
  thread_local OwnCounters counters;
  counters.count(predicate, undecided);
}

}  // namespace ogc::reference
