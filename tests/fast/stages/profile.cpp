#include "fast/stages/profile.hpp"

#include <thread>

#include "fast/cpu/backend.hpp"
#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

void wait(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

}  // namespace

TEST_CASE("the time of a stage inside another one is not the outer one's, and is given out once", "[unit]") {
  CpuBackend backend;
  StageClock<CpuBackend> clock(backend, true);
  const auto start = std::chrono::steady_clock::now();
  clock.time(StepStage::sweep, [&] {
    wait(2);
    clock.time(StepStage::detection, [] { wait(20); });
    wait(3);
  });
  wait(10);  // outside all stages
  const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - start;
  const std::vector<double> times = clock.take();
  REQUIRE(times.size() == step_stage_names().size());
  const double sweep = times[static_cast<std::size_t>(StepStage::sweep)],
               detection = times[static_cast<std::size_t>(StepStage::detection)];
  CHECK(detection >= 20);
  CHECK(sweep >= 5);
  CHECK(sweep + detection <= passed.count() - 10);
  CHECK(times[static_cast<std::size_t>(StepStage::metrics)] == 0);
  CHECK(clock.take() == std::vector<double>(times.size()));
}

TEST_CASE("a clock that is off calls and measures nothing", "[unit]") {
  CpuBackend backend;
  StageClock<CpuBackend> clock(backend, false);
  int calls = 0;
  clock.time(StepStage::begin, [&] {
    ++calls;
    wait(1);
  });
  CHECK(calls == 1);
  CHECK(clock.take() == std::vector<double>(step_stage_names().size()));
}

TEST_CASE("the ends of detections and iterations are times since the step began, each noted once", "[unit]") {
  CpuBackend backend;
  StageClock<CpuBackend> clock(backend, true, true);
  wait(30);  // before the step
  const auto begun = std::chrono::steady_clock::now();
  clock.begin_step();
  clock.time(StepStage::initial_guess, [&] { clock.time(StepStage::detection, [] { wait(4); }); });
  clock.time(StepStage::sweep, [&] {
    clock.end_iteration(0);
    wait(2);
    clock.end_iteration(1);
    clock.time(StepStage::detection, [] { wait(8); });
    clock.end_iteration(1);
    wait(1);
    clock.end_iteration(2);
  });
  const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - begun;
  const EventEnds ends = clock.take_ends();
  REQUIRE(ends.detections.size() == 2);
  REQUIRE(ends.iterations.size() == 3);
  CHECK(ends.detections[0] >= 4);
  CHECK(ends.iterations[0] >= ends.detections[0]);
  CHECK(ends.iterations[1] >= ends.iterations[0] + 2);
  CHECK(ends.detections[1] >= ends.iterations[1] + 8);
  CHECK(ends.iterations[2] >= ends.detections[1] + 1);
  CHECK(ends.iterations[2] <= passed.count());
  CHECK(clock.take_ends().iterations.empty());
}

TEST_CASE("a clock of stages alone notes no ends", "[unit]") {
  CpuBackend backend;
  StageClock<CpuBackend> clock(backend, true);
  clock.begin_step();
  clock.time(StepStage::detection, [] {});
  clock.end_iteration(0);
  CHECK(clock.take_ends().detections.empty());
  CHECK_FALSE(clock.by_iteration());
}
