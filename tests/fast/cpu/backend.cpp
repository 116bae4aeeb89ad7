#include "fast/cpu/backend.hpp"

#include <atomic>
#include <numeric>

#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

/// Counts the parts in which a loop runs, and its items.
struct Counted {
  std::atomic<int>*parts, *items;
};
void run_range(const Counted& counted, int begin, int end) {
  ++*counted.parts;
  *counted.items += end - begin;
}

}  // namespace

TEST_CASE("loops of many items have parts for many threads, those of few items one", "[unit]") {
  CpuBackend backend;
  for (const int n : {0, 1, 64, 100000}) {
    std::atomic<int> parts = 0, items = 0;
    backend.for_each(n, Counted{&parts, &items});
    CHECK(items == n);
    if (n > 64)
      CHECK(parts > 1);
    else
      CHECK(parts == 1);
  }
}

TEST_CASE("pairs are sorted by their keys, and keep their order where keys are equal", "[property]") {
  CpuBackend backend;
  for (const int n : {0, 1, 2, 63, 5000}) {
    std::vector<std::uint64_t> keys;
    for (int i = 0; i < n; ++i) keys.push_back(std::uint64_t(i) * 7919 % 13 << 60 | std::uint64_t(i) % 3);
    std::vector<int> values(keys.size()), expected(keys.size());
    std::iota(values.begin(), values.end(), 0);
    std::iota(expected.begin(), expected.end(), 0);
    const auto key = [&](int i) { return keys[static_cast<std::size_t>(i)]; };
    const auto by_key = [&](int a, int b) { return key(a) < key(b); };
    std::stable_sort(expected.begin(), expected.end(), by_key);
    std::vector<std::uint64_t> sorted = keys;
    std::sort(sorted.begin(), sorted.end());
    backend.sort_pairs(keys.data(), values.data(), n);
    CHECK(keys == sorted);
    CHECK(values == expected);
  }
}
