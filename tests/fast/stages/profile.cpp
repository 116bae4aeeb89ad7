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
