// Worlds on the device against simulations that run alone there.
#include <vector>

#include "fast/contestant.hpp"
#include "fast/cuda/cuda.hpp"
#include "fast/worlds.hpp"
#include "tests/catch.hpp"
#include "tests/fast/worlds/worlds_cases.hpp"

using namespace ogc;
using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

/// Requires the rows and the end of a run of the scene alone, from a launch of its own.
void expect_alone(const compare::Scene& scene, std::int64_t steps, const std::vector<compare::StepMetrics>& rows,
                  const compare::Snapshot& end, int list_capacity = 0) {
  const auto single = start_cuda_worlds(std::span(&scene, 1), {}, list_capacity);
  expect_same(rows, single->advance(steps)[0]);
  expect_same(end, single->snapshot(0));
}

}  // namespace

TEST_CASE("each world on the device has the bits of its run alone, for 1, 3 and 300 worlds, beside one that fails",
          "[gpu]") {
  for (const int count : {1, 3, 300}) {  // 300 do not run at once
    CAPTURE(count);
    std::vector<compare::Scene> scenes = different_worlds(count);
    if (count > 1) make_fail(scenes[1]);
    const auto worlds = start_cuda_worlds(scenes, {});
    const Rows rows = worlds->advance(20);
    for (int w = 0; w < count; ++w) {
      CAPTURE(w);
      CHECK(worlds->has_failed(w) == (count > 1 && w == 1));
      if (w > 2 && w % 11 != 0) continue;
      expect_alone(scenes[static_cast<std::size_t>(w)], 20, rows[static_cast<std::size_t>(w)], worlds->snapshot(w));
    }
  }
}

#if defined(OGC_STRICT)
TEST_CASE("without contraction a world on the device has the bits of both backends", "[gpu]") {
  const std::vector<compare::Scene> scenes = different_worlds(3);
  const auto worlds = start_cuda_worlds(scenes, {});
  const Rows rows = worlds->advance(20);
  for (const Backend backend : {Backend::cpu, Backend::cuda}) {
    for (int w = 0; w < 3; ++w) {
      const auto single = contestant(backend).start(scenes[static_cast<std::size_t>(w)], {});
      expect_same(rows[static_cast<std::size_t>(w)], single->advance(20));
      expect_same(worlds->snapshot(w), single->snapshot());
    }
  }
}
#endif

TEST_CASE("a world on the device whose lists are too small repeats its step alone, and keeps its bits", "[gpu]") {
  const std::vector<compare::Scene> scenes = {falling_sheet(5, -5), falling_sheet(9, 0.4)};  // rises; falls
  const auto worlds = start_cuda_worlds(scenes, {}, 4);
  const Rows rows = worlds->advance(30);
  CHECK(repeats(rows[0]) == 0);
  CHECK(repeats(rows[1]) > 0);
  for (int w = 0; w < 2; ++w)
    expect_alone(scenes[static_cast<std::size_t>(w)], 30, rows[static_cast<std::size_t>(w)], worlds->snapshot(w), 4);
}

TEST_CASE("a world on the device that is reset repeats its bits while the others go on", "[gpu]") {
  const std::vector<compare::Scene> scenes = different_worlds(3);
  const auto worlds = start_cuda_worlds(scenes, {});
  const compare::Snapshot start = worlds->snapshot(2);
  worlds->advance(9);
  const compare::Snapshot first = worlds->snapshot(2);
  worlds->reset(2, start);
  worlds->advance(9);
  expect_same(first, worlds->snapshot(2));
  CHECK(worlds->snapshot(0).step == 18);
}
