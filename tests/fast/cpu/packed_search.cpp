// Tests that a search whose candidates are collected lowers its limit like a search that tests each candidate at once.
#include "fast/cpu/packed_search.hpp"

#include <vector>

#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

/// A query with given results: primitive i has the distance `apart[i]` from the owner, and computing the exact distance
/// (meet) lowers the search's limit to `limit[i]`.
struct Scripted {
  std::vector<float> apart, limit;

  float candidate_limit(const Search&, const Offer& offer) const { return offer.primitive == 3 ? -1.0F : 1.0F; }
  bool is_idle(const Search&, const Offer& offer, float) const { return offer.reach > 0; }
  float meet(const Search&, int primitive, float) const { return limit[static_cast<std::size_t>(primitive)]; }
};

Pack separations(const Scripted& query, const Search&, const int* primitive) {
  return Pack::of_each([&](int k) { return query.apart[static_cast<std::size_t>(primitive[k])]; });
}

/// Returns the search's limit after these primitives have been offered. An entry k ≥ 100 means primitive k − 100,
/// offered as idle (is_idle).
float limit_after(const Scripted& query, const std::vector<int>& offered) {
  NotedPair room[1];
  int count = 0;
  ListsView common;
  common.noted = room, common.noted_capacity = 1, common.noted_count = &count;
  LocalNotes notes(common);
  Search search{};
  search.limit = 9;
  packed::Waiting<Scripted> waiting{query, notes, search, {}, 0, {}, {}, {}};
  for (const int primitive : offered) waiting.take({primitive % 100, 0, primitive < 100 ? 0.0F : 1.0F});
  waiting.look();
  return search.limit;
}

}  // namespace

TEST_CASE("what was met narrows a search, however many wait, and what is beyond its limit does not", "[unit]") {
  const Scripted query{{0.5F, 0.5F, 2, 0.5F, 0.5F, 0.5F}, {4, 3, 0, 1, 5, 2}};
  CHECK(limit_after(query, {}) == 9);
  CHECK(limit_after(query, {0}) == 4);
  CHECK(limit_after(query, {4, 0}) == 4);
  CHECK(limit_after(query, {0, 1, 4}) == 3);
  CHECK(limit_after(query, {2, 3}) == 9);  // primitive 2 is beyond the limit, primitive 3 is no candidate
  CHECK(limit_after(query, {0, 1, 2, 3, 4}) == 3);
  CHECK(limit_after(query, {1, 4, 0, 0, 5, 4}) == 2);
  CHECK(limit_after(query, {101, 0}) == 4);
  CHECK(limit_after(query, {104, 101, 100, 105, 1}) == 3);
}
