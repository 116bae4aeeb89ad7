#include "fast/cpu/backend.hpp"

#include <atomic>
#include <limits>
#include <numeric>
#include <random>

#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

struct Counted {
  std::atomic<int>*parts, *items;
};
void run_range(const Counted& counted, int begin, int end) {
  ++*counted.parts;
  *counted.items += end - begin;
}

/// Receives two numbers of each row: the smallest one, and the one that follows the `rank` smallest ones.
struct TwoOfRow {
  static constexpr int rank = 16;
  float *least, *after;
  void operator()(int i, float smallest, float after_rank) const { least[i] = smallest, after[i] = after_rank; }
};

}  // namespace

TEST_CASE("of each row the smallest number, and the one that so many come before, equal ones counted", "[property]") {
  CpuBackend backend;
  std::mt19937 random(5);
  std::vector<int> offsets{0};
  std::vector<float> values;
  for (int row = 0; row < 500; ++row) {
    const auto count = row < 40 ? static_cast<unsigned long>(row) : random() % 1500;
    for (auto k = count; k > 0; --k) values.push_back(static_cast<float>(random() % (row % 3 == 0 ? 7 : 100000)));
    offsets.push_back(static_cast<int>(values.size()));
  }
  std::vector<float> least(500), after(500);
  backend.for_each_row(500, offsets.data(), values.data(), TwoOfRow{least.data(), after.data()});
  for (std::size_t row = 0; row < 500; ++row) {
    std::vector<float> sorted(values.begin() + offsets[row], values.begin() + offsets[row + 1]);
    std::ranges::sort(sorted);
    sorted.resize(sorted.size() + TwoOfRow::rank + 1, std::numeric_limits<float>::infinity());
    CHECK(least[row] == sorted[0]);
    CHECK(after[row] == sorted[TwoOfRow::rank]);
  }
}

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

TEST_CASE("a sort looks at the bits it is told, and keys that differ elsewhere keep their order", "[unit]") {
  CpuBackend backend;
  std::vector<std::uint64_t> keys{0xf21U, 0x023U, 0xf10U, 0x0ffU, 0x11fU};
  std::vector<int> values{0, 1, 2, 3, 4};
  backend.sort_pairs(keys.data(), values.data(), 5, {4, 8});
  CHECK(keys == std::vector<std::uint64_t>{0xf10U, 0x11fU, 0xf21U, 0x023U, 0x0ffU});
  CHECK(values == std::vector<int>{2, 4, 0, 1, 3});
}
