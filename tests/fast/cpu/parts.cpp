// The parts of a simulation compute the bits of the whole (fast/kernels/parts.hpp), here on the host's threads.
#include "fast/cpu/simulation.hpp"
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
