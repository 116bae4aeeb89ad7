#include "fast/kernels/arithmetic/arctangent.hpp"

#include <cmath>
#include <random>

#include "tests/catch.hpp"

using ogc::fast::arctangent2;

TEST_CASE("the hinge's arctangent stays within 4 u of the angle in every quadrant and at every ratio", "[property]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-3.14159, 3.14159), exponent(-20, 20);
  double worst = 0;
  for (int i = 0; i < 400000; ++i) {
    const double turned = i % 2 == 0 ? angle(random) : std::copysign(std::exp2(exponent(random) - 20), angle(random));
    const double length = std::exp2(exponent(random));
    const float x = static_cast<float>(length * std::cos(turned)), y = static_cast<float>(length * std::sin(turned));
    const double exact = std::atan2(static_cast<double>(y), static_cast<double>(x));
    worst = std::max(worst, std::abs(arctangent2(y, x) - exact) / std::abs(exact));
  }
  CHECK(worst <= 4 * 0x1p-24);
}

TEST_CASE("the hinge's arctangent is exact where angles are known, odd, and 0 at the origin", "[unit]") {
  CHECK(arctangent2(0.0f, 1.0f) == 0.0f);
  CHECK(arctangent2(0.0f, 0.0f) == 0.0f);
  CHECK(arctangent2(1.0f, 0.0f) == static_cast<float>(std::acos(0.0)));
  CHECK(arctangent2(0.0f, -1.0f) == static_cast<float>(std::acos(-1.0)));
  CHECK(arctangent2(1.0f, 1.0f) == static_cast<float>(std::atan(1.0)));
  for (const float y : {1e-8f, 0.3f, 0.41f, 0.42f, 5.0f}) {
    for (const float x : {-2.0f, -0.1f, 0.7f, 1.0f}) CHECK(arctangent2(-y, x) == -arctangent2(y, x));
  }
}
