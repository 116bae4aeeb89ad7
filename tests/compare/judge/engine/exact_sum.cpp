#include "compare/judge/engine/exact_sum.hpp"

#include <random>

#include "tests/catch.hpp"

using ogc::compare::ExactSum;

TEST_CASE("the sign of a sum survives cancellation that double arithmetic loses", "[unit]") {
  ExactSum sum;
  sum.add(0x1p80);
  sum.add(0x1p-80);
  sum.add(-0x1p80);
  REQUIRE(sum.sign() == 1);
  sum.add(-0x1p-80);
  REQUIRE(sum.sign() == 0);
  sum.add(-0x1p-300);
  REQUIRE(sum.sign() == -1);
}

TEST_CASE("products are added without rounding", "[unit]") {
  // (1 + 2⁻⁵²)² − (1 + 2⁻⁵¹) = 2⁻¹⁰⁴
  ExactSum sum;
  sum.add_product(1 + 0x1p-52, 1 + 0x1p-52);
  sum.add(-(1 + 0x1p-51));
  REQUIRE(sum.sign() == 1);
  sum.add(-0x1p-104);
  REQUIRE(sum.sign() == 0);
}

TEST_CASE("signs agree with 128-bit integers", "[property]") {
  __extension__ using Wide = __int128;
  std::mt19937_64 engine(7);
  for (int trial = 0; trial < 20000; ++trial) {
    ExactSum sum;
    Wide exact = 0;
    for (int k = 0; k < 8; ++k) {
      const int shift = static_cast<int>(engine() % 60);
      const std::int64_t term = static_cast<std::int64_t>(engine() % 2001) - 1000;
      sum.add(std::ldexp(static_cast<double>(term), shift));
      exact += static_cast<Wide>(term) << shift;
    }
    REQUIRE(sum.sign() == (exact > 0) - (exact < 0));
  }
}
