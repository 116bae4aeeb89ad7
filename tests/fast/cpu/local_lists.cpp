#include "fast/cpu/local_lists.hpp"

#include <algorithm>
#include <vector>

#include "tests/catch.hpp"

using namespace ogc::fast;

TEST_CASE("a list of one thread moves to the common one in order, and what finds no room there is counted and handed back", "[unit]") {
  std::vector<int> common(5, -1), left;
  int count = 3;
  LocalList<int, 4> list;
  for (int k = 0; k < 4; ++k) list.items()[(*list.count())++] = 10 + k;
  CHECK(!list.has_room_for(1));
  list.flush(common.data(), 5, &count, [&](int item) { left.push_back(item); });
  CHECK(common == std::vector<int>{-1, -1, -1, 10, 11});
  CHECK(left == std::vector<int>{12, 13});
  CHECK(count == 7);
  CHECK(list.has_room_for(4));
  list.flush(common.data(), 5, &count, [](int) { FAIL("an empty list has nothing to move"); });
  CHECK(count == 7);
}

TEST_CASE("pairs that a thread notes reach the common list, however many they are", "[property]") {
  constexpr int pairs = 5000;
  for (const int capacity : {pairs, 700, 0}) {
    std::vector<NotedPair> noted(pairs, {-7, -7});
    int count = 0;
    ListsView common;
    common.noted = noted.data(), common.noted_capacity = capacity, common.noted_count = &count;
    {
      LocalNotes notes(common);
      const ListsView local = notes.view();
      for (int k = 0; k < pairs; ++k) {
        notes.expect(1);
        local.note({k, k + 1}, k % 2 == 0);
      }
    }
    CHECK(count == pairs);
    int wrong = 0;
    for (int k = 0; k < pairs; ++k) {
      const NotedPair& pair = noted[static_cast<std::size_t>(k)];
      const int second = k % 2 == 0 ? ~(k + 1) : k + 1;
      wrong += k < capacity ? pair.first != k || pair.second != second : pair.first != -7;
    }
    CHECK(wrong == 0);
  }
}
