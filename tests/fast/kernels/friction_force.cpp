#include "fast/kernels/friction_force.hpp"

#include "tests/catch.hpp"
#include "tests/fast/numeric.hpp"

using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

constexpr double u = 0x1p-24;
constexpr float friction = 0.3f, normal_force = 0.02f, limit = 1e-4f;

ForceAndBlock of(const Vec& normal, const Vec& moved, float weight = 1) {
  ForceAndBlock sum;
  add_friction<float>(normal, moved, weight, weight * weight, friction, normal_force, limit, sum);
  return sum;
}

Vec random_normal(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const D3 n{normal(random), normal(random), normal(random)};
  return narrow((1 / length(n)) * n);
}

}  // namespace

TEST_CASE("friction is tangential, opposes the slip and never exceeds mu lambda", "[property]") {
  std::mt19937 random(41);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 20000; ++i) {
    const Vec n = random_normal(random);
    const Vec moved = std::pow(10.0f, static_cast<float>(i % 6 - 7)) *
                      Vec{normal(random), normal(random), normal(random)};
    const D3 f = wide(of(n, moved).force), tangential = wide(moved) - dot(wide(n), wide(moved)) * wide(n);
    const double size = friction * normal_force;
    // The slip errs by 3 u (u = 2⁻²⁴) of the movement, from which the normal part is subtracted.
    REQUIRE(std::abs(dot(f, wide(n))) <= 12 * u * size * length(moved) / std::max(length(tangential), 1e-12));
    REQUIRE(dot(f, tangential) <= 0);
    REQUIRE(length(f) <= size * (1 + 8 * u));
  }
}

TEST_CASE("at rest the block is 2 mu lambda/(eps_v h) on the tangent plane, and the force follows it", "[unit]") {
  const ForceAndBlock rest = of({0, 1, 0}, {});
  const double stiffness = 2.0 * friction * normal_force / limit;
  CHECK(rest.force.x == 0);
  CHECK(rest.block.xx == Approx(stiffness));
  CHECK(rest.block.zz == Approx(stiffness));
  CHECK(rest.block.yy == 0);
  CHECK(of({0, 1, 0}, {1e-9f, 1e-4f, 0}).force.x == Approx(-stiffness * 1e-9).epsilon(1e-4));
}

TEST_CASE("friction is f1 of the slip: quadratic below eps_v h, then constant, with the limit in between", "[unit]") {
  const auto size = [](float slip) { return -of({0, 1, 0}, {slip, 0, 0}).force.x / (friction * normal_force); };
  for (const float y : {0.1f, 0.5f, 0.9f}) CHECK(size(y * limit) == Approx(-y * y + 2 * y));
  CHECK(size(limit) == Approx(1));
  CHECK(size(30 * limit) == Approx(1));
}

TEST_CASE("friction on the two sides cancels, and its block is positive semidefinite", "[property]") {
  std::mt19937 random(42);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 2000; ++i) {
    const Vec n = random_normal(random), moved = 1e-4f * Vec{normal(random), normal(random), normal(random)};
    const ForceAndBlock first = of(n, moved, 1), a = of(n, moved, -0.25f), b = of(n, moved, -0.75f);
    REQUIRE(length(wide(first.force) + wide(a.force) + wide(b.force)) <= 4 * u * friction * normal_force);
    REQUIRE(least_curvature(first.block, random) >=
            -8 * u * first.block.xx - 8 * u * first.block.yy - 8 * u * first.block.zz);
  }
}
