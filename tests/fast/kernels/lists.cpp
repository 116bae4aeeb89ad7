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

TEST_CASE("a list that is full counts on and writes nothing beyond its end", "[unit]") {
  NotedPair noted[3] = {};
  const NotedPair pair{1, 2};
  int noted_count = 0;
  ListsView lists{};
  lists.noted = noted, lists.noted_count = &noted_count, lists.noted_capacity = 2;
  for (int i = 0; i < 4; ++i) lists.note(pair);
  CHECK(noted_count == 4);
  CHECK(noted[1].second == 2);
  CHECK(noted[2].second == 0);
}

TEST_CASE("the counts of a detection begin at 0, and nothing beyond them is touched", "[unit]") {
  int overflow = 0, noted_count = 7, cursor = 7, raw[2][3] = {{7, 7, 7}, {7, 7, 7}}, incidence[2][4] = {{7, 7, 7, 7}, {7, 7, 7, 7}};
  ListsView lists{};
  lists.overflow = &overflow, lists.noted_count = &noted_count, lists.cursor = &cursor;
  lists.buckets = 2, lists.raw_counts = raw[0], lists.raw_filled = raw[1];
  lists.incidence_counts = incidence[0], lists.incidence_filled = incidence[1];
  for (int i = 0; i < 4; ++i) PrepareLists{lists, 3}(i);
  CHECK(noted_count == 0);
  CHECK(cursor == 0);
  for (int k = 0; k < 2; ++k) {
    CHECK(std::vector<int>(raw[k], raw[k] + 3) == std::vector<int>{0, 0, 7});
    CHECK(std::vector<int>(incidence[k], incidence[k] + 4) == std::vector<int>{0, 0, 0, 7});
  }
}
