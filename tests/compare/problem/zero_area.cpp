// Tests points on one line, and points one ulp beside it, for which rounded arithmetic decides wrongly.
#include "compare/problem/zero_area.hpp"

#include <cmath>
#include <random>

#include "tests/catch.hpp"

using namespace ogc::compare;

namespace {

// Returns a multiple of 2⁻²⁰ below 1 in modulus; its sums and products with small integers are exact.
double dyadic(std::mt19937& random) {
  return std::uniform_int_distribution<int>(-(1 << 19), 1 << 19)(random) * 0x1p-20;
}

}  // namespace

TEST_CASE("points on a line have zero area however they are placed, and one ulp beside it they have not",
          "[property]") {
  std::mt19937 random(11);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a{dyadic(random), dyadic(random), dyadic(random)}, d{dyadic(random), dyadic(random), dyadic(random)};
    const double s = 1 + i % 7, t = -3 + i % 5;
    const Vec3 b{a.x + s * d.x, a.y + s * d.y, a.z + s * d.z}, c{a.x + t * d.x, a.y + t * d.y, a.z + t * d.z};
    if (s == t || t == 0 || d.y == 0 || b.x == 0) continue;
    CHECK(has_zero_area(a, b, c));
    CHECK_FALSE(has_zero_area(a, {std::nextafter(b.x, 2), b.y, b.z}, c));
  }
}

TEST_CASE("repeated points have zero area, and a right angle has not", "[unit]") {
  CHECK(has_zero_area({1, 2, 3}, {1, 2, 3}, {4, 5, 6}));
  CHECK(has_zero_area({1, 2, 3}, {1, 2, 3}, {1, 2, 3}));
  CHECK_FALSE(has_zero_area({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  CHECK_FALSE(has_zero_area({0, 0, 0}, {0, 1, 0}, {0, 0, 1}));
  CHECK_FALSE(has_zero_area({0, 0, 0}, {0, 0, 1}, {1, 0, 0}));
}

TEST_CASE("the extremes of the allowed range are decided exactly", "[unit]") {
  const double least = 0x1p-20, most = 0x1p20;
  CHECK(has_zero_area({-most, -most, -most}, {least, least, least}, {most, most, most}));
  CHECK_FALSE(has_zero_area({-most, -most, -most}, {least, std::nextafter(least, 1), least}, {most, most, most}));
  const double rounded = 0.1;
  CHECK(has_zero_area({0, 0, 0}, {rounded, rounded, rounded}, {3, 3, 3}));
  CHECK_FALSE(has_zero_area({0, 0, 0}, {0.1, 0.3, 0}, {1, 3, 0}));
}
