#include "fast/kernels/truncate.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "tests/catch.hpp"

namespace {

using namespace ogc::fast;

/// Returns whether ‖x − p‖ ≤ b in 113-bit arithmetic: squares of 24-bit differences are exact up to 2⁻¹¹².
bool obeys(const Vec& p, const Vec& x, float b) {
  using Quad = __float128;
  const Quad u = Quad(x.x) - p.x, v = Quad(x.y) - p.y, w = Quad(x.z) - p.z;
  return u * u + v * v + w * w <= Quad(b) * b;
}

double distance(const Vec& p, const Vec& x) {
  return std::hypot(static_cast<double>(x.x) - p.x, static_cast<double>(x.y) - p.y, static_cast<double>(x.z) - p.z);
}

bool same_bits(const Vec& a, const Vec& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

}  // namespace

TEST_CASE("truncate: the stored position obeys the bound, whatever the sizes of position, step and bound",
          "[property]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::uniform_int_distribution<int> exponent(-30, 20);
  const auto point = [&](int e) {
    return Vec{std::ldexp(unit(random), e), std::ldexp(unit(random), e), std::ldexp(unit(random), e)};
  };
  int broken = 0, moved = 0, flagged_wrongly = 0, short_by_far = 0;
  for (int i = 0; i < 1000000; ++i) {
    const int e = exponent(random);
    const Vec p = point(e), x = i % 3 == 0 ? point(exponent(random)) : p + point(e - exponent(random) / 3);
    const float b = std::ldexp(std::abs(unit(random)), i % 2 == 0 ? e - 3 : exponent(random));
    const Truncated cut = truncate({p, b}, x);
    broken += !obeys(p, cut.position, b);
    flagged_wrongly += cut.cut == obeys(p, x, b);
    moved += !cut.cut && !same_bits(cut.position, x);
    const double size = std::max({std::abs(static_cast<double>(p.x)), std::abs(static_cast<double>(p.y)),
                                  std::abs(static_cast<double>(p.z))}) +
                        b;
    short_by_far += cut.cut && static_cast<double>(b) - distance(p, cut.position) > 8 * 0x1p-24 * size;
  }
  CHECK(broken == 0);
  CHECK(flagged_wrongly == 0);
  CHECK(moved == 0);
  CHECK(short_by_far == 0);
}

TEST_CASE("truncate: hand cases", "[unit]") {
  CHECK(same_bits(truncate({{0, 0, 0}, 5}, {3, 4, 0}).position, {3, 4, 0}));
  CHECK_FALSE(truncate({{0, 0, 0}, 5}, {3, 4, 0}).cut);
  CHECK(same_bits(truncate({{1, 0, 0}, 2}, {9, 0, 0}).position, {3, 0, 0}));
  CHECK(same_bits(truncate({{1, 2, 3}, 0}, {9, 9, 9}).position, {1, 2, 3}));
  CHECK(truncate({{1, 2, 3}, 0}, {9, 9, 9}).cut);
  CHECK_FALSE(truncate({{1, 2, 3}, 0}, {1, 2, 3}).cut);
}

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
