#include "fast/kernels/arithmetic/logarithm.hpp"

#include <cmath>
#include <random>

#include "tests/catch.hpp"

using ogc::fast::log_ratio;

TEST_CASE("the logarithm of a ratio stays within 5 u of its value, from neighbouring numbers to 2^40", "[property]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> exponent(-20, 20), share(0, 1);
  double worst = 0;
  for (int i = 0; i < 1000000; ++i) {
    const float d = std::exp2(exponent(random));
    float r = i % 4 == 0   ? d * (1 + std::exp2(-24 * share(random)))
              : i % 4 == 1 ? d * (1 + share(random))
              : i % 4 == 2 ? d * (2 + share(random))
                           : d * std::exp2(20 * share(random));
    if (i % 16 == 0) r = std::nextafter(d, 2 * d);
    const double exact = std::log(static_cast<double>(r) / d);
    if (exact == 0) continue;
    worst = std::max(worst, std::abs(log_ratio(r, d) - exact) / exact);
  }
  CHECK(worst <= 5 * 0x1p-24);
}

TEST_CASE("the logarithm of equal numbers is 0, and that of powers of two is a multiple of ln 2", "[unit]") {
  CHECK(log_ratio(3, 3) == 0.0f);
  for (int k = 1; k < 40; ++k) CHECK(log_ratio(std::ldexp(3.0f, k), 3) == Approx(k * std::log(2.0)).epsilon(1e-7));
}
