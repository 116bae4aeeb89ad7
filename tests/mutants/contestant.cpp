// The fast path's probes over kernels that tests/mutants.py has rewritten, on one thread: mutants run in forked processes, where a pool of threads is gone.
#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>
#include <type_traits>
#include <vector>

#include "fast/kernels/search.hpp"
#include "fast/kernels/team.hpp"
#include "fast/stages/probes.hpp"
#include "tests/mutants/contestant.hpp"

namespace {

/// fast/stages/backend.hpp as far as the probes of single stages need it.
class SerialBackend {
 public:
  static constexpr bool is_device = false;

  template <class T>
  class Buffer {
   public:
    T* data() { return items_.data(); }
    const T* data() const { return items_.data(); }
    std::size_t size() const { return items_.size(); }
    void resize(std::size_t n) { items_.resize(n); }
    void upload(const T* from, std::size_t n) { items_.assign(from, from + n); }
    void download(T* to, std::size_t n) const { std::copy_n(items_.data(), n, to); }
    void fill_zero() {
      if (!items_.empty()) std::memset(static_cast<void*>(items_.data()), 0, items_.size() * sizeof(T));
    }

   private:
    std::vector<T> items_;
  };

  template <class F>
  void for_each(int n, F f) {
    for (int i = 0; i < n; ++i) f(i);
  }
  template <class F>
  void for_each_counted(const int* n, int capacity, F f) {
    for_each(std::min(*n, capacity), f);
  }
  template <int W, class F>
  void for_each_team(int n, F f, ogc::fast::Start) {
    for_each(n, [&f](int i) { f(i, ogc::fast::SerialTeam<W>{}); });
  }
  template <class First, class Second>
  void search(const ogc::fast::Searches<First>& first, const ogc::fast::Searches<Second>& second) {
    for_each(first.count + second.count, ogc::fast::SearchAlone<First, Second>{first, second});
  }
  void exclusive_scan(const int* in, int* out, int n) {
    out[n] = std::accumulate(in, in + n, 0);
    std::exclusive_scan(in, in + n, out, 0);
  }
  void sort_pairs(std::uint64_t* keys, int* values, int n) {
    std::vector<std::pair<std::uint64_t, int>> items;
    for (int i = 0; i < n; ++i) items.emplace_back(keys[i], values[i]);
    std::stable_sort(items.begin(), items.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (int i = 0; i < n; ++i) std::tie(keys[i], values[i]) = items[static_cast<std::size_t>(i)];
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
  struct Recording {
    void clear() {}
  };
  template <class Body>
  void replay(Recording&, int times, Body body) {
    for (int k = 0; k < times; ++k) body();
  }
  std::vector<double> replay_milliseconds() const { return {}; }
  void synchronize() {}
};

}  // namespace

namespace ogc::tests {

compare::Contestant mutant_contestant() { return fast::probe_contestant("mutant", std::make_shared<SerialBackend>()); }

}  // namespace ogc::tests
