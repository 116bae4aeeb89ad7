// Worlds, whose programs a host thread runs, against simulations that run alone.
#include <stdexcept>

#include "compare/problem/error.hpp"
#include "fast/cpu/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/fast/worlds/start_host.hpp"
#include "tests/fast/worlds/worlds_cases.hpp"

using namespace ogc;
using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

/// Starts the scene alone on the CPU backend.
std::unique_ptr<compare::Simulation> alone(const compare::Scene& scene) { return start_cpu(scene, {}); }

}  // namespace

TEST_CASE("each world has the bits of its run alone, for 1, 3 and 12 worlds", "[property]") {
  for (const int count : {1, 3, 12}) {
    CAPTURE(count);
    const std::vector<compare::Scene> scenes = different_worlds(count);
    const auto worlds = start_host_worlds(scenes);
    worlds->advance(7);
    const Rows rows = worlds->advance(13);
    for (int w = 0; w < count; ++w) {
      CAPTURE(w);
      const auto single = alone(scenes[static_cast<std::size_t>(w)]);
      single->advance(7);
      expect_same(rows[static_cast<std::size_t>(w)], single->advance(13));
      expect_same(worlds->snapshot(w), single->snapshot());
    }
  }
}

TEST_CASE("the worlds of these tests have contacts, detections within a step, and different programs", "[unit]") {
  const auto worlds = start_host_worlds(different_worlds(3));
  const Rows rows = worlds->advance(20);
  for (const auto& of_world : rows) {
    CHECK(of_world.back().vertex_facet_contacts > 0);
    CHECK(of_world.back().edge_edge_contacts > 0);
    std::int64_t detections = 0;
    for (const compare::StepMetrics& row : of_world) detections += row.discrete_detections;
    CHECK(detections > 20);
  }
  CHECK(rows[0].back().iterations != rows[1].back().iterations);
}

TEST_CASE("a world whose lists are too small repeats its step alone, and keeps its bits", "[property]") {
  const std::vector<compare::Scene> scenes = {falling_sheet(5, -5), falling_sheet(9, 0.4)};  // rises; falls
  const auto worlds = start_host_worlds(scenes, {}, 4);
  const Rows rows = worlds->advance(30);
  CHECK(repeats(rows[0]) == 0);
  CHECK(repeats(rows[1]) > 0);
  for (int w = 0; w < 2; ++w) {
    const auto single = start_cpu(scenes[static_cast<std::size_t>(w)], {}, 4);
    expect_same(rows[static_cast<std::size_t>(w)], single->advance(30));
    expect_same(worlds->snapshot(w), single->snapshot());
  }
}

TEST_CASE("a world that fails stops and is named; the others go on to their bits", "[property]") {
  std::vector<compare::Scene> scenes = different_worlds(3);
  make_fail(scenes[1]);
  const auto worlds = start_host_worlds(scenes);
  const Rows rows = worlds->advance(20);
  CHECK(worlds->has_failed(1));
  CHECK(rows[1].size() == 1);
  CHECK((rows[1].back().status & compare::step_not_finite) != 0);
  for (const int w : {0, 2}) {
    CHECK(!worlds->has_failed(w));
    const auto single = alone(scenes[static_cast<std::size_t>(w)]);
    expect_same(rows[static_cast<std::size_t>(w)], single->advance(20));
    expect_same(worlds->snapshot(w), single->snapshot());
  }
  CHECK(worlds->advance(1)[1].empty());  // it does nothing until it is reset
}

TEST_CASE("a world that is reset repeats its bits while the others go on", "[property]") {
  const std::vector<compare::Scene> scenes = different_worlds(3);
  const auto worlds = start_host_worlds(scenes);
  const compare::Snapshot start = worlds->snapshot(2);
  const Rows first = worlds->advance(9);
  worlds->reset(2, start);
  const Rows second = worlds->advance(9);
  REQUIRE(second[2].front().step == 1);
  CHECK(worlds->snapshot(0).step == 18);
  for (std::size_t k = 0; k < 9; ++k) {
    CHECK(bits_of(first[2][k].contact_energy) == bits_of(second[2][k].contact_energy));
    CHECK(first[2][k].discrete_detections == second[2][k].discrete_detections);
  }
  const auto single = alone(scenes[2]);
  single->advance(9);
  expect_same(worlds->snapshot(2), single->snapshot());
}

TEST_CASE("a failed world that is reset runs again", "[property]") {
  std::vector<compare::Scene> scenes = different_worlds(2);
  make_fail(scenes[1]);
  const auto worlds = start_host_worlds(scenes);
  const compare::Snapshot start = worlds->snapshot(1);
  const Rows rows = worlds->advance(20);
  REQUIRE(worlds->has_failed(1));
  worlds->reset(1, start);
  CHECK(!worlds->has_failed(1));
  CHECK(worlds->advance(20)[1].size() == rows[1].size());
}

TEST_CASE("worlds end at steps of their own", "[unit]") {
  const std::vector<compare::Scene> scenes = different_worlds(3);
  const auto worlds = start_host_worlds(scenes);
  const std::vector<std::int64_t> steps = {70, 0, 5};  // more than a frame, none, less than a frame
  const Rows rows = worlds->advance(steps);
  for (std::size_t w = 0; w < 3; ++w) {
    CHECK(rows[w].size() == static_cast<std::size_t>(steps[w]));
    CHECK(worlds->snapshot(static_cast<int>(w)).step == steps[w]);
  }
  const auto single = alone(scenes[0]);
  expect_same(rows[0], single->advance(70));
  CHECK_THROWS_AS(worlds->advance(std::vector<std::int64_t>{1, 2}), std::invalid_argument);
}

TEST_CASE("worlds on the CPU have the bits of runs alone, and name the world that fails", "[property]") {
  std::vector<compare::Scene> scenes = different_worlds(4);
  make_fail(scenes[3]);
  const auto worlds = start_worlds(Backend::cpu, scenes);
  const Rows rows = worlds->advance(20);
  for (int w = 0; w < 4; ++w) {
    const auto single = alone(scenes[static_cast<std::size_t>(w)]);
    expect_same(rows[static_cast<std::size_t>(w)], single->advance(20));
    expect_same(worlds->snapshot(w), single->snapshot());
    CHECK(worlds->has_failed(w) == (w == 3));
  }
}

TEST_CASE("worlds that do not fit into the machine's memory are refused, and the message says how many fit", "[unit]") {
  const compare::Scene scene = falling_sheet(5, 0);
  const std::size_t most = free_bytes(Backend::cpu) / world_bytes(scene);
  expect_room(Backend::cpu, scene, most);
  CHECK_THROWS_WITH(expect_room(Backend::cpu, scene, most + 1),
                    ContainsSubstring("run at most " + std::to_string(most) + " worlds"));
  CHECK_THROWS_AS(expect_room(Backend::cpu, scene, most + 1), compare::ResourceError);
  CHECK_THROWS_AS(start_worlds(Backend::cpu, {}), compare::InputError);
  CHECK_THROWS_AS(start_worlds(Backend::cpu, std::span(&scene, 1), {.profile = true}), compare::InputError);
}

TEST_CASE("the memory of a world grows with its mesh", "[unit]") {
  const std::size_t small = world_bytes(falling_sheet(5, 0)), large = world_bytes(falling_sheet(40, 0));
  CHECK(small > std::size_t{1} << 19);  // the list of noted pairs alone has half a mebibyte
  CHECK(large > small + 1600 * sizeof(float) * 3 * 10);
}
