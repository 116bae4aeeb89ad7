// Tests the compiler's rounding. At -O2 the vectoriser of straight-line code in g++ 12.2 removes adjacent conversions
// to single precision and back. Comparisons of values "as single precision stores them" then have no effect. The build
// disables that pass, and this test checks it.
#include "tests/catch.hpp"

#include "compare/problem/vector.hpp"

namespace {

[[gnu::noinline]] ogc::compare::Vec3 through_single(const ogc::compare::Vec3& v) {
  return {static_cast<double>(static_cast<float>(v.x)), static_cast<double>(static_cast<float>(v.y)),
          static_cast<double>(static_cast<float>(v.z))};
}

}  // namespace

TEST_CASE("neighbouring conversions to single precision and back round", "[unit]") {
  const ogc::compare::Vec3 v{0.1, 0.2, 0.3}, w = through_single(v);
  CHECK(w.x != v.x);
  CHECK(w.y != v.y);
  CHECK(w.z != v.z);
}
