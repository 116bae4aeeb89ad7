#include "fast/kernels/lists.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include "tests/catch.hpp"

using namespace ogc::fast;

TEST_CASE("segments of any length are sorted, equal entries among them", "[property]") {
  std::mt19937 random(1);
  for (int n = 0; n < 200; ++n) {
    for (const unsigned values : {3u, 1000u, ~0u}) {
      std::vector<unsigned> items(static_cast<std::size_t>(n));
      for (unsigned& item : items) item = static_cast<unsigned>(random()) % values;
      std::vector<unsigned> sorted = items;
      std::sort(sorted.begin(), sorted.end());
      sort_segment(items.data(), n);
      REQUIRE(items == sorted);
    }
  }
}

TEST_CASE("lists overflow where more came than there is room for, pairs or contacts, and stay so", "[unit]") {
  const auto overflow_of = [](int noted, int contacts, int before) {
    int noted_count = noted, cursor = contacts, overflow = before;
    ListsView lists{};
    lists.noted_count = &noted_count, lists.cursor = &cursor, lists.overflow = &overflow;
    lists.noted_capacity = 5, lists.capacity = 7;
    CheckCapacity{lists}(0);
    return overflow;
  };
  CHECK(overflow_of(5, 7, 0) == 0);
  CHECK(overflow_of(6, 7, 0) == 1);
  CHECK(overflow_of(5, 8, 0) == 1);
  CHECK(overflow_of(0, 0, 1) == 1);
}
