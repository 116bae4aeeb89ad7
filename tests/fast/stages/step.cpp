#include "fast/stages/step.hpp"

#include "fast/cpu/packed_gaps.hpp"
#include "tests/catch.hpp"

using namespace ogc::fast;

TEST_CASE("iterations are grouped where fewer than one in four asks for a detection", "[unit]") {
  for (const std::int64_t steps : {1, 3, 64}) {
    for (const int iterations : {1, 7, 8, 40}) {
      for (std::int64_t redetections = 0; redetections <= steps * iterations; ++redetections) {
        const double share = static_cast<double>(redetections) / static_cast<double>(steps * iterations);
        REQUIRE(iterations_in_group(redetections, steps * iterations) == (share < 0.25 ? 5 : 1));
      }
    }
  }
}
