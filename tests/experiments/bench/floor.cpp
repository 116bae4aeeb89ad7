#include "experiments/bench/floor.hpp"

#include "tests/catch.hpp"

using namespace ogc::experiments;

TEST_CASE("only machines with measured limits have floors", "[unit]") {
  CHECK(limits_of("NVIDIA H200, CUDA 13.0"));
  CHECK_FALSE(limits_of("2 threads"));
}

TEST_CASE("the floor of a sweep is its instructions or its sectors, and its launches", "[unit]") {
  const MachineLimits machine = *limits_of("NVIDIA H200");
  const double gaps = 6 * machine.seconds_between_launches, issued = machine.warp_instructions_per_second;
  CHECK(sweep_floor(machine, {0, 0, 0, 6}) == Approx(gaps));
  CHECK(sweep_floor(machine, {1e-3 * issued, 1, 1, 6}) == Approx(1e-3 + gaps));
  // all in the cache; again in the cache; nothing in the cache
  CHECK(sweep_floor(machine, {1, 30e6, 90e6, 6}) == Approx(90e6 / 7.1e12 + gaps));
  CHECK(sweep_floor(machine, {1, 100e6, 150e6, 6}) == Approx(100e6 / 4.4e12 + 50e6 / 7.1e12 + gaps));
  CHECK(sweep_floor(machine, {1, 300e6, 500e6, 6}) == Approx(500e6 / 4.4e12 + gaps));
}

TEST_CASE("the floor of a sweep grows with each kind of work", "[property]") {
  const MachineLimits machine = *limits_of("NVIDIA H200");
  const IterationWork work{1e8, 200e6, 300e6, 6};
  IterationWork idle = work, spread = work, more = work;
  idle.warp_instructions *= 10;
  spread.sector_bytes *= 1.5;
  ++more.launches;
  for (const IterationWork& greater : {idle, spread, more})
    CHECK(sweep_floor(machine, greater) > sweep_floor(machine, work));
}

TEST_CASE("the floor of worlds is their instructions or their bytes, and no launch", "[unit]") {
  const MachineLimits machine = *limits_of("NVIDIA H200");
  IterationWork sum;
  for (int world = 0; world < 3; ++world) sum += 40.0 * IterationWork{1e6, 2e6, 3e6, 6};
  CHECK(sum.launches == 0);
  CHECK(sum.warp_instructions == Approx(120e6));
  CHECK(worlds_floor(machine, sum) == Approx(std::max(120e6 / machine.warp_instructions_per_second, 240e6 / 7.1e12)));
}
