// The parts of a simulation compute the bits of the whole (fast/kernels/parts.hpp), here on the host's threads.
#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "fast/cpu/simulation.hpp"
#include "fast/kernels/search.hpp"
#include "tests/catch.hpp"
#include "tests/fast/parts_cases.hpp"

using namespace ogc;
using namespace ogc::fast;
using namespace ogc::fast::test;

TEST_CASE("parts of a simulation compute the bits of the whole") {
  const compare::Scene scene = falling_sheets();
  const compare::SimulationOptions options{.energies = true};
  const auto whole = start_cpu(scene, options);
  const Outcome expected = run(*whole, 40);
  REQUIRE(expected.rows.back().vertex_facet_contacts > 50);
  REQUIRE(expected.rows.back().edge_edge_contacts > 50);
  for (const int parts : {2, 5}) {
    CAPTURE(parts);
    const auto divided = start_cpu_parts(scene, options, parts);
    require_equal(run(*divided, 40), expected);
  }
}

TEST_CASE("parts repeat a step together when a list of one of them was too small") {
  const compare::Scene scene = falling_sheets();
  const auto whole = start_cpu(scene, {});
  const auto divided = start_cpu_parts(scene, {}, 3, 1);
  const Outcome parts = run(*divided, 20);
  require_equal(parts, run(*whole, 20));
  std::int64_t repeats = 0;
  for (const compare::StepMetrics& row : parts.rows) repeats += row.repeats;
  CHECK(repeats > 0);
}

// A simulation ends a frame when a list is nearly full (ListRoom). Parts note different numbers of pairs, so one part
// would end its frame while the others wait for it. So they go on until a list is too small, which all learn.
TEST_CASE("no part of a simulation ends a frame because a list is nearly full") {
  const compare::Scene scene = falling_sheets_detected_once();
  const auto whole = start_cpu(scene, {});
  const Outcome expected = run(*whole, 30);
  const int capacity = nearly_full_capacity(expected);
  const auto divided = start_cpu_parts(scene, {}, 2, capacity);
  const Outcome parts = run(*divided, 30);
  require_equal(parts, expected);
  REQUIRE(parts.end.capacities.size() == 2);
  for (const compare::StepMetrics& row : parts.rows) REQUIRE(row.repeats == 0);
  CHECK(parts.end.capacities[0] == capacity);
}

TEST_CASE("parts end a step together that has settled") {
  compare::Scene scene = falling_sheets();
  scene.motions.clear();  // no step settles while a vertex lags behind its target
  scene.settings.settled_move = 3e-4;
  const auto whole = start_cpu(scene, {});
  const Outcome expected = run(*whole, 30);
  std::set<std::int64_t> iterations;
  for (const compare::StepMetrics& row : expected.rows) iterations.insert(row.iterations);
  REQUIRE(iterations.size() > 4);  // odd and even numbers: either buffer may have the end
  for (const int parts : {2, 3}) {
    CAPTURE(parts);
    const auto divided = start_cpu_parts(scene, {}, parts);
    require_equal(run(*divided, 30), expected);
  }
}

namespace {

/// A query whose searches tell their numbers.
struct Numbered {
  Search begin(int i) const {
    Search search;
    search.owner = i;
    return search;
  }
};

}  // namespace

TEST_CASE("parts make each search once, in runs of neighbours") {
  for (const int count : {0, 1, 63, 64, 1000, 300'000}) {
    for (const int parts : {1, 2, 3, 4, 7, 64}) {
      CAPTURE(count, parts);
      const Searches<Numbered> all{{}, count, {}};
      std::vector<int> times(static_cast<std::size_t>(count), 0), own_counts;
      int neighbours = 0;
      for (int p = 0; p < parts; ++p) {
        const Searches<Numbered> own = all.of_part(parts, p);
        own_counts.push_back(own.count);
        for (int i = 0; i < own.count; ++i) {
          const int number = own.begin(i).owner;
          REQUIRE(number >= 0);
          REQUIRE(number < count);
          ++times[static_cast<std::size_t>(number)];
          neighbours += i > 0 && number == own.begin(i - 1).owner + 1 ? 1 : 0;
        }
      }
      CHECK(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; }));
      const auto [least, most] = std::minmax_element(own_counts.begin(), own_counts.end());
      CHECK(*most - *least <= count / (64 * parts) + 1);
      if (count == 300'000) CHECK(neighbours > count * 9 / 10);
    }
  }
}

TEST_CASE("parts go on from a snapshot of the whole") {
  const compare::Scene scene = falling_sheets();
  const auto whole = start_cpu(scene, {});
  whole->advance(20);
  const compare::Snapshot middle = whole->snapshot();
  const auto divided = start_cpu_parts(scene, {}, 2);
  divided->restore(middle);
  require_equal(run(*divided, 20), run(*whole, 20));
}

TEST_CASE("more parts than free vertices leave parts without work") {
  compare::Scene scene = empty_scene();
  add_sheet(scene, 2, 0.1, 0.01, false);
  const auto whole = start_cpu(scene, {});
  const auto divided = start_cpu_parts(scene, {}, 6);
  require_equal(run(*divided, 5), run(*whole, 5));
}

TEST_CASE("a scene that cannot be divided is refused by name") {
  compare::Scene scene = falling_sheets();
  scene.settings.bounds = compare::Bounds::planes;
  CHECK_THROWS_WITH(start_cpu_parts(scene, {}, 2), ContainsSubstring("bounds=ball"));
}
