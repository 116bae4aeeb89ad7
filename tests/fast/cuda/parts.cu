// Several devices compute the bits of one (fast/kernels/parts.hpp). Each case needs two devices or more.
#include <cuda_runtime.h>

#include "fast/cuda/cuda.hpp"
#include "tests/catch.hpp"
#include "tests/fast/parts_cases.hpp"

using namespace ogc;
using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

/// Returns the numbers of devices to try: 2, 4, … as far as the machine has them. Warns if it has only one.
std::vector<int> numbers_of_devices() {
  int all = 0;
  if (cudaGetDeviceCount(&all) != cudaSuccess) all = 0;
  std::vector<int> numbers;
  for (int n = 2; n <= all; n *= 2) numbers.push_back(n);
  if (numbers.empty()) WARN("nothing is compared: this machine shows one device");
  return numbers;
}

}  // namespace

TEST_CASE("several devices compute the bits of one", "[gpu]") {
  const compare::Scene scene = falling_sheets();
  const compare::SimulationOptions options{.energies = true};
  const auto whole = start_cuda(scene, options);
  const Outcome expected = run(*whole, 70);
  for (const int devices : numbers_of_devices()) {
    CAPTURE(devices);
    const auto divided = start_cuda_parts(scene, options, devices);
    require_equal(run(*divided, 70), expected);
  }
}

TEST_CASE("several devices repeat a step together when a list of one was too small", "[gpu]") {
  const compare::Scene scene = falling_sheets();
  const auto whole = start_cuda(scene, {});
  const Outcome expected = run(*whole, 40);
  for (const int devices : numbers_of_devices()) {
    CAPTURE(devices);
    const auto divided = start_cuda_parts(scene, {}, devices, 1);
    require_equal(run(*divided, 40), expected);
  }
}

TEST_CASE("no device ends a frame because a list is nearly full", "[gpu]") {
  const compare::Scene scene = falling_sheets_detected_once();
  const auto whole = start_cuda(scene, {});
  const Outcome expected = run(*whole, 30);
  const int capacity = nearly_full_capacity(expected);
  for (const int devices : numbers_of_devices()) {
    CAPTURE(devices);
    const auto divided = start_cuda_parts(scene, {}, devices, capacity);
    const Outcome parts = run(*divided, 30);
    require_equal(parts, expected);
    for (const compare::StepMetrics& row : parts.rows) REQUIRE(row.repeats == 0);
    REQUIRE(parts.end.capacities.size() == 2);
    CHECK(parts.end.capacities[0] == capacity);
  }
}

// Stages that are timed are not recorded: the host launches each kernel.
TEST_CASE("devices compute the same bits launch by launch", "[gpu]") {
  const compare::Scene scene = falling_sheets();
  const compare::SimulationOptions options{.profile = true, .energies = true};
  const auto whole = start_cuda(scene, options);
  const Outcome expected = run(*whole, 10);
  REQUIRE(expected.rows.back().vertex_facet_contacts > 0);
  for (const int devices : numbers_of_devices()) {
    CAPTURE(devices);
    const auto divided = start_cuda_parts(scene, options, devices);
    require_equal(run(*divided, 10), expected);
  }
}

TEST_CASE("more devices than the machine has are refused by number", "[gpu]") {
  CHECK_THROWS_WITH(start_cuda_parts(falling_sheets(), {}, 65), ContainsSubstring("65 devices are asked for"));
}
