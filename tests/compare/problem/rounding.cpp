// Tests the compiler's rounding. g++ 12.2 at -O2 removes adjacent conversions to single precision and back (its
// vectoriser of straight-line code). Then every comparison "as single precision stores it" is without effect. The build
// disables that pass, and this test checks that it did.
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
