#include "fast/kernels/arithmetic/solve3.hpp"

#include <cmath>
#include <random>

#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

bool finite(const Vec& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

ForceAndBlock random_block(std::mt19937& random, double spread) {
  std::normal_distribution<float> normal;
  ForceAndBlock sum;
  for (int k = 0; k < 3; ++k)
    sum.add_outer(static_cast<float>(std::pow(10.0, spread * k)), Vec{normal(random), normal(random), normal(random)});
  sum.add_identity(0.1f);
  sum.force = {normal(random), normal(random), normal(random)};
  return sum;
}

}  // namespace

TEST_CASE("the 3x3 solve leaves a residual of a few roundings for positive definite blocks", "[property]") {
  std::mt19937 random(3);
  for (int i = 0; i < 20000; ++i) {
    const ForceAndBlock s = random_block(random, i % 3);
    const Vec x = solve_symmetric(s.block, s.force, 1.0f);
    const Symmetric3& h = s.block;
    const double size = (std::abs(h.xx) + std::abs(h.yy) + std::abs(h.zz)) *
                        (std::abs(x.x) + std::abs(x.y) + std::abs(x.z));
    const double rx = static_cast<double>(h.xx) * x.x + static_cast<double>(h.xy) * x.y +
                      static_cast<double>(h.xz) * x.z - s.force.x;
    const double ry = static_cast<double>(h.xy) * x.x + static_cast<double>(h.yy) * x.y +
                      static_cast<double>(h.yz) * x.z - s.force.y;
    const double rz = static_cast<double>(h.xz) * x.x + static_cast<double>(h.yz) * x.y +
                      static_cast<double>(h.zz) * x.z - s.force.z;
    // LDL^T without pivoting is backward stable for positive definite matrices: 12 roundings of three terms, relative
    // to the trace.
    REQUIRE(std::abs(rx) + std::abs(ry) + std::abs(rz) <= 36 * 0x1p-24 * size);
  }
}

TEST_CASE("singular, indefinite and not finite blocks give the inertia's gradient step, never NaN", "[unit]") {
  const Vec force{1, -2, 3};
  const Symmetric3 rank_one{1, 1, 1, 1, 1, 1}, zero{}, indefinite{1, 2, 0, 1, 0, 1};
  for (const Symmetric3& h : {rank_one, zero, indefinite, Symmetric3{NAN, 0, 0, 1, 0, 1},
                              Symmetric3{1, 0, 0, 1, NAN, 1}, Symmetric3{1, 0, 0, 1, 0, -1}}) {
    const Vec x = solve_symmetric(h, force, 0.5f);
    CHECK(finite(x));
    CHECK(x.x == 0.5f);
    CHECK(x.y == -1.0f);
    CHECK(x.z == 1.5f);
  }
}

TEST_CASE("a solve by factors has the bits of a solve at once, for definite and indefinite blocks", "[property]") {
  std::mt19937 random(4);
  int fallbacks = 0;
  for (int i = 0; i < 20000; ++i) {
    ForceAndBlock s = random_block(random, i % 3);
    if (i % 4 == 0) s.block.zz = -s.block.zz;
    const Factors factors = factors_of(s.block);
    fallbacks += factors.is_definite ? 0 : 1;
    const Vec once = solve_symmetric(s.block, s.force, 0.5f), factored = solve(factors, s.force, 0.5f);
    REQUIRE(once.x == factored.x);
    REQUIRE(once.y == factored.y);
    REQUIRE(once.z == factored.z);
  }
  CHECK(fallbacks >= 5000);
}

TEST_CASE("a pivot of one unit in the last place of its diagonal entry is noise, whatever the entry's size", "[unit]") {
  const Vec force{1, -2, 3};
  for (const float size : {0x1p20f, 0x1p-20f}) {
    const float next = std::nextafter(size * size, INFINITY);
    // the matrix (1, size)(1, size)ᵀ in x and y, or in x and z; its last entry is raised by one unit in the last place
    for (const Symmetric3& h : {Symmetric3{1, size, 0, next, 0, 1}, Symmetric3{1, 0, size, 1, 0, next}})
      CHECK(solve_symmetric(h, force, 0.5f).y == -1.0f);
  }
}

TEST_CASE("a contact far stiffer than the inertia still gives a finite answer", "[property]") {
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 20000; ++i) {
    ForceAndBlock sum;
    Vec n{normal(random), normal(random), normal(random)};
    n = (1.0f / std::sqrt(dot(n, n))) * n;
    sum.add_outer(std::pow(10.0f, static_cast<float>(i % 14)), n);
    sum.add_identity(0.4f);
    sum.force = std::pow(10.0f, static_cast<float>(i % 9)) * n;
    REQUIRE(finite(solve_symmetric(sum.block, sum.force, 2.5f)));
  }
}
