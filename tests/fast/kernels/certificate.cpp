#include "fast/kernels/certificate.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace ogc::fast;

TEST_CASE("the certificate allows a move as long as the bound, along any axis, and nothing longer", "[unit]") {
  const Vec from{1, -2, 3};
  // The distance is 13/4, because 3² + 4² + 12² = 13². All differences are exact.
  const Vec at_bound{1.75f, -1, 6};
  CHECK_FALSE(is_outside(Ball{from, 3.25f}, at_bound));
  CHECK(is_outside(Ball{from, std::nextafter(3.25f, 0.0f)}, at_bound));
  for (const Vec& step : {Vec{0.5f, 0, 0}, Vec{0, -0.5f, 0}, Vec{0, 0, 0.5f}}) {
    CHECK_FALSE(is_outside(Ball{from, 0.5f}, from + step));
    CHECK(is_outside(Ball{from, 0.4375f}, from + step));
  }
  CHECK_FALSE(is_outside(Ball{from, 0}, from));
}
