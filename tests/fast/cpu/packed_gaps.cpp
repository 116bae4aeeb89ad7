#include "fast/cpu/packed_gaps.hpp"

#include <random>

#include "tests/catch.hpp"

using namespace ogc::fast;

TEST_CASE(
    "gaps of a node's four children at once are those of its boxes one by one, whatever primitives and reaches stand "
    "beside them",
    "[property]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-1, 1), size(0, 0.2F);
  const auto box = [&] {
    Box result;
    const Vec corner{place(random), place(random), place(random)};
    result.include(corner);
    result.include(Vec{corner.x + size(random), corner.y + size(random), corner.z + size(random)});
    return result;
  };
  for (int trial = 0; trial < 2000; ++trial) {
    Quad quad;
    const int filled = trial % 5;  // the other children are empty
    for (int k = 0; k < filled; ++k) {
      const Box own = box();
      const int primitive = trial % 3 == 0 ? -1 : (trial % 3 == 1 ? k : (1 << 27) - 1 - k);
      quad.child[k] = {own.lower, trial % 2 == 0 ? 0.0F : size(random), own.upper, primitive};
    }
    const Box other = box();
    const float limit = size(random) * size(random);
    const QuadGaps gaps = squared_gaps(quad, other, limit);
    for (int k = 0; k < 4; ++k) {
      const float expected = squared_gap(quad.child[k].box(), other);
      REQUIRE(gaps[k] == expected);
      REQUIRE((gaps.near >> k & 1U) == (expected <= larger(limit, quad.child[k].reach) ? 1U : 0U));
    }
  }
}
