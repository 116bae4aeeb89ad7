#include "fast/kernels/certificate.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace ogc::fast;

TEST_CASE("the certificate allows a move as long as the bound, along any axis, and nothing longer", "[unit]") {
  const Vec from{1, -2, 3};
  // 3² + 4² + 12² = 13², in quarters, so that no difference is rounded.
  const Vec at_bound{1.75f, -1, 6};
  CHECK_FALSE(bound_violated(at_bound, from, 3.25f));
  CHECK(bound_violated(at_bound, from, std::nextafter(3.25f, 0.0f)));
  for (const Vec& step : {Vec{0.5f, 0, 0}, Vec{0, -0.5f, 0}, Vec{0, 0, 0.5f}}) {
    CHECK_FALSE(bound_violated(from + step, from, 0.5f));
    CHECK(bound_violated(from + step, from, 0.4375f));
  }
  CHECK_FALSE(bound_violated(from, from, 0));
}
