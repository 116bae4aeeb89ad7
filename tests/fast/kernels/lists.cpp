#include "fast/kernels/lists.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <random>
#include <vector>

#include "tests/catch.hpp"

using namespace ogc::fast;

TEST_CASE("records stand in canonical order, each once with its lowest-numbered edges, in whatever order and however often contacts came", "[property]") {
  constexpr int vertices = 3, edges = 40, buckets = 2 * vertices + edges;
  std::mt19937 random(1);
  const auto below = [&random](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::vector<EdgeEnds> ends(edges, EdgeEnds{0, 1});
  SurfaceView surface{};
  surface.vertex_count = vertices, surface.edge_count = edges, surface.edges = ends.data();
  for (const int n : {0, 1, 2, 3, 10, 50, 300}) {
    std::vector<RawContact> raw(static_cast<std::size_t>(n) + 1), bucketed(raw);
    std::map<std::array<int, 2>, std::array<int, 2>> kept;
    std::vector<int> raw_counts(buckets), raw_offsets(buckets + 1), record_counts(buckets), record_offsets(buckets + 1), incidence_counts(vertices);
    for (int i = 0; i < n; ++i) {
      const int first = vertices + below(4), low = below(3);  // edges as faces, few of them, so that many come twice
      raw[static_cast<std::size_t>(i)] = {vertices + first, vertices + 4 + below(6), low, low + 1 + below(3)};
      const RawContact& contact = raw[static_cast<std::size_t>(i)];
      ++raw_counts[static_cast<std::size_t>(contact.bucket)];
      const auto [place, is_new] = kept.try_emplace({contact.bucket, contact.second}, std::array<int, 2>{contact.low, contact.high});
      if (!is_new) place->second = std::min(place->second, {contact.low, contact.high});
    }
    const auto scan = [](const std::vector<int>& counts, std::vector<int>& offsets) { std::partial_sum(counts.begin(), counts.end(), offsets.begin() + 1); };
    scan(raw_counts, raw_offsets);
    std::vector<EdgeEdgeRecord> records(raw.size());
    std::vector<int> filled(buckets);
    int overflow = 0, edge_edge_count = 0;
    ListsView lists{};
    lists.overflow = &overflow, lists.edge_edge_count = &edge_edge_count, lists.raw = raw.data(), lists.bucketed = bucketed.data(), lists.buckets = buckets;
    lists.raw_offsets = raw_offsets.data(), lists.raw_filled = filled.data(), lists.edge_edge = records.data();
    lists.record_counts = record_counts.data(), lists.record_offsets = record_offsets.data(), lists.incidence_counts = incidence_counts.data();
    for (int i = 0; i < n; ++i) FillBuckets{lists}(i);
    for (int i = 0; i < n; ++i) DropDuplicates{lists, {surface}}(i);
    scan(record_counts, record_offsets);
    std::vector<int> incidence_offsets(vertices + 1), incidence_filled(vertices);
    std::vector<LooseIncidence> loose(4 * raw.size());
    std::vector<Incidence> incidences(loose.size());
    scan(incidence_counts, incidence_offsets);
    lists.incidence_offsets = incidence_offsets.data(), lists.incidence_filled = incidence_filled.data();
    lists.loose = loose.data(), lists.incidences = incidences.data();
    for (int i = 0; i < n; ++i) WriteRecords{lists, {surface}}(i);
    REQUIRE(edge_edge_count == static_cast<int>(kept.size()));
    std::vector<std::uint32_t> resolved(loose.size());
    const auto resolve = [&resolved](int place, Incidence incidence) { resolved[static_cast<std::size_t>(place)] = incidence.code; };
    const int total = incidence_offsets.back();
    for (int i = 0; i < total; ++i) RankIncidences<decltype(resolve)>{lists, resolve}(i);
    for (int v = 0; v < vertices; ++v) {
      const auto begin = incidences.begin() + incidence_offsets[static_cast<std::size_t>(v)], end = incidences.begin() + incidence_offsets[static_cast<std::size_t>(v) + 1];
      REQUIRE(std::is_sorted(begin, end, [](Incidence a, Incidence b) { return a.code < b.code; }));
    }
    for (int i = 0; i < total; ++i) REQUIRE(resolved[static_cast<std::size_t>(i)] == incidences[static_cast<std::size_t>(i)].code);
    std::size_t next = 0;
    for (const auto& [place, edges_of] : kept) {
      const EdgeEdgeRecord& record = records[next++];
      REQUIRE(std::min(record.first_edge, record.second_edge) == edges_of[0]);
      REQUIRE(std::max(record.first_edge, record.second_edge) == edges_of[1]);
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
  for (int i = 0; i < 4; ++i) lists.note(pair, i % 2 == 0);
  CHECK(noted_count == 4);
  CHECK(noted[0].second == ~2);
  CHECK(noted[1].second == 2);
  CHECK(noted[2].second == 0);
}

TEST_CASE("the counts of a detection begin at 0, and nothing beyond them is touched", "[unit]") {
  int overflow = 0, noted_count = 7, cursor = 7, edge_edge_count = 7, raw[3][3] = {{7, 7, 7}, {7, 7, 7}, {7, 7, 7}}, incidence[2][4] = {{7, 7, 7, 7}, {7, 7, 7, 7}};
  ListsView lists{};
  lists.overflow = &overflow, lists.noted_count = &noted_count, lists.cursor = &cursor;
  lists.edge_edge_count = &edge_edge_count;
  lists.buckets = 2, lists.raw_counts = raw[0], lists.raw_filled = raw[1], lists.record_counts = raw[2];
  lists.incidence_counts = incidence[0], lists.incidence_filled = incidence[1];
  for (int i = 0; i < 4; ++i) PrepareLists{lists, 3}(i);
  CHECK(noted_count == 0);
  CHECK(cursor == 0);
  CHECK(edge_edge_count == 0);
  for (const auto& counts : raw) CHECK(std::vector<int>(counts, counts + 3) == std::vector<int>{0, 0, 7});
  for (const auto& counts : incidence) CHECK(std::vector<int>(counts, counts + 4) == std::vector<int>{0, 0, 0, 7});
}
