#include "compare/problem/text.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>

#include "tests/catch.hpp"

using namespace ogc::compare;

TEST_CASE("the nearest name is the one with the fewest edits, the first of several", "[unit]") {
  constexpr std::array<std::string_view, 3> known{"density", "friction", "fiction"};
  CHECK(nearest_name("densty", known) == "density");
  CHECK(nearest_name("ddensity", known) == "density");
  CHECK(nearest_name("densitz", known) == "density");
  CHECK(nearest_name("ffiction", known) == "friction");
  CHECK(nearest_name("f", known) == "friction");
  CHECK(nearest_name("fi", known) == "fiction");
  CHECK(nearest_name("", known) == "density");
  CHECK(nearest_name("anything", {}).empty());
}

TEST_CASE("a complaint about a name proposes one only where there are any", "[unit]") {
  constexpr std::array<std::string_view, 1> known{"twist"};
  CHECK(unknown_name("scene", "twits", known) == "unknown scene 'twits'; did you mean 'twist'?");
  CHECK(unknown_name("scene", "twits", {}) == "unknown scene 'twits'");
}

TEST_CASE("printed numbers read back as the same double", "[unit]") {
  using Limits = std::numeric_limits<double>;
  for (const double value : {0.1, 1.0 / 3, -2.5e-7, 1e300, 4.0, Limits::min(), Limits::max(), Limits::denorm_min()}) {
    CHECK(std::strtod(shortest(value).c_str(), nullptr) == value);
  }
  CHECK(shortest(0.1) == "0.1");
}

TEST_CASE("what is printed for a single-precision value is short and rounds to it", "[unit]") {
  CHECK(as_typed(static_cast<double>(0.01f)) == 0.01);
  CHECK(as_typed(static_cast<double>(-9.81f)) == -9.81);
  CHECK(as_typed(0.01) == 0.01);
  CHECK(as_typed(1.0 / 3) == 1.0 / 3);
  CHECK(as_typed(1e300) == 1e300);
  CHECK(std::signbit(as_typed(-0.0)));
  std::mt19937 random(5);
  for (int i = 0; i < 10000; ++i) {
    const auto single = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (std::isfinite(single)) CHECK(static_cast<float>(as_typed(static_cast<double>(single))) == single);
  }
}
