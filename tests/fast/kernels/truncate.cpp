#include "fast/kernels/truncate.hpp"

#include <limits>

#include "tests/catch.hpp"

namespace {

using namespace ogc::fast;

bool same_bits(const Vec& a, const Vec& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

}  // namespace

TEST_CASE("truncate: a coordinate far too small for two doubles does not pass beside one at the bound", "[property]") {
  const Vec previous{-0x1p-6f, 0x1p-5f, 0.0f};
  const float bound = 0x1.97a3p-8f;
  const Vec tie{previous.x - bound, previous.y, 0.0f};
  REQUIRE(previous.x - tie.x == bound);
  CHECK_FALSE(truncate({previous, bound}, tie).cut);
  for (const float speck : {0x1p-69f, -0x1.84b0f2p-69f, 0x1p-149f}) {
    const Truncated kept = truncate({previous, bound}, {tie.x, tie.y, speck});
    CHECK(kept.cut);
    CHECK((kept.position.z == 0 || previous.x - kept.position.x < bound));
  }
}

TEST_CASE("truncate: a difference that does not fit into a double is beyond the bound, along each coordinate",
          "[unit]") {
  const float large = 0x1p20f, speck = 0x1p-100f;
  for (int axis = 0; axis < 3; ++axis) {
    Vec previous{0, 0, 0}, tie{0, 0, 0}, beyond{0, 0, 0};
    (axis == 0 ? previous.x : axis == 1 ? previous.y : previous.z) = large;
    (axis == 0 ? beyond.x : axis == 1 ? beyond.y : beyond.z) = -speck;
    CHECK(is_exactly_within({previous, large}, tie));
    CHECK_FALSE(is_exactly_within({previous, large}, beyond));
  }
}

TEST_CASE("truncate: a position that is not finite goes back to the previous one", "[unit]") {
  for (const float bad : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    const Truncated cut = truncate({{1, 2, 3}, 1}, {0, bad, 0});
    CHECK(cut.cut);
    CHECK(same_bits(cut.position, {1, 2, 3}));
  }
}
