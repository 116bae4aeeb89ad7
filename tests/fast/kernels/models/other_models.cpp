// Tests the kernels of the models that are not the default against differences of energies. The energies are written
// here a second time.
#include <random>

#include "fast/kernels/sweep/gather.hpp"
#include "tests/catch.hpp"
#include "tests/fast/numeric.hpp"

using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

// Holds one triangle with edges of about 1 in both shapes, so that forces have the size of the stiffness.
struct Triangle {
  TriangleRest rest;
  SurfaceMaterial material;
  std::vector<Vec> x;

  explicit Triangle(std::mt19937& random) {
    std::uniform_real_distribution<float> near(-0.3f, 0.3f), stiff(1, 10);
    rest.gradient[1][0] = 1 + near(random);
    rest.gradient[1][1] = near(random);
    rest.gradient[2][1] = 1 + near(random);
    for (int axis = 0; axis < 2; ++axis) rest.gradient[0][axis] = -(rest.gradient[1][axis] + rest.gradient[2][axis]);
    rest.area = 0.5f;
    material.lame_lambda = stiff(random);
    material.lame_mu = stiff(random);
    x = {{near(random), near(random), near(random)},
         {1 + near(random), near(random), near(random)},
         {near(random), 1 + near(random), near(random)}};
  }
  MembraneStencil stencil(int corner) const {
    const int b = (corner + 1) % 3, c = (corner + 2) % 3;
    return {{rest.gradient[b][0], rest.gradient[b][1]}, {rest.gradient[c][0], rest.gradient[c][1]}, rest.area};
  }
  Vec to(int corner, int next) const {
    return x[static_cast<std::size_t>((corner + next) % 3)] - x[static_cast<std::size_t>(corner)];
  }
  double energy(const std::vector<D3>& at) const {
    D3 f[2];
    for (int column = 0; column < 2; ++column)
      for (std::size_t k = 0; k < 3; ++k) f[column] += static_cast<double>(rest.gradient[k][column]) * at[k];
    const double product = length(cross(f[0], f[1])), squares = dot(f[0], f[0]) + dot(f[1], f[1]);
    const double mu = material.lame_mu, lambda = material.lame_lambda;
    return rest.area * (mu / 2 * (squares - 2 * product) + (lambda + mu) / 2 * (product - 1) * (product - 1));
  }
};

// Forces of size 10 with some tens of roundings, or differences with a step of 10⁻⁴ of energies of size 10 with third
// derivatives of size 100.
constexpr double accepted = 1e-4;

}  // namespace

TEST_CASE(
    "stable Neo-Hookean kernel: the force is minus the slope of the energy, forces add up to nothing, the block is no "
    "less than the slope's",
    "[property]") {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    Triangle t(random);
    if (i % 4 == 0) t.x[2] = 0.5f * t.x[0] + 0.5f * t.x[1] + 0.05f * t.x[2];  // pressed flat
    const std::vector<D3> at{wide(t.x[0]), wide(t.x[1]), wide(t.x[2])};
    D3 total;
    for (int corner = 0; corner < 3; ++corner) {
      ForceAndBlock sum;
      StableNeoHookean::add_elastic(t.stencil(corner), t.material, t.to(corner, 1), t.to(corner, 2), sum);
      const D3 force = force_by_differences([&](const std::vector<D3>& x) { return t.energy(x); }, at,
                                            static_cast<std::size_t>(corner), 1e-4);
      CHECK(length(wide(sum.force) - force) < 10 * accepted);
      CHECK(least_curvature(sum.block, random) > -accepted);
      total += wide(sum.force);
    }
    CHECK(length(total) < accepted);
  }
}

TEST_CASE(
    "stable Neo-Hookean kernel: a collapsed triangle, down to a point, gives finite numbers and pulls its corners "
    "together",
    "[unit]") {
  std::mt19937 random(2);
  for (const float size : {0.0f, 1e-30f, 1e-20f, 1e-12f, 1e-6f}) {
    Triangle t(random);
    ForceAndBlock sum;
    StableNeoHookean::add_elastic(t.stencil(0), t.material, {size, 0, 0}, {0, size * size, 0}, sum);
    CHECK(std::isfinite(sum.force.x + sum.force.y + sum.force.z));
    CHECK(std::isfinite(sum.block.xx + sum.block.yy + sum.block.zz));
    CHECK(least_curvature(sum.block, random) >= -accepted);
  }
  Triangle t(random);
  ForceAndBlock sum;
  StableNeoHookean::add_elastic(t.stencil(0), t.material, {1, 0, 0}, {0.5f, 0, 0}, sum);
  CHECK(sum.force.x > 0);
}

TEST_CASE("isometric kernel: flat hinges exert nothing, and force and block are those of the energy", "[property]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> near(-0.3f, 0.3f);
  const HingeWeights rest{{0.8f, -1.1f, -0.9f}};
  const float all[4] = {1.2f, 0.8f, -1.1f, -0.9f};  // their sum is 0 with sufficient accuracy: 0.8 − 1.1 − 0.9 = −1.2
  for (int i = 0; i < 100; ++i) {
    std::vector<D3> x(4);
    for (D3& p : x) p = {near(random), near(random), near(random)};
    const auto energy = [&](const std::vector<D3>& at) {
      D3 l;
      for (std::size_t k = 1; k < 4; ++k) l += static_cast<double>(rest.weight[k - 1]) * (at[k] - at[0]);
      return 1.5 * dot(l, l);
    };
    constexpr int others[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {1, 0, 2}};
    for (std::size_t own = 0; own < 4; ++own) {
      HingeSeen hinge{};
      hinge.stencil = {3.0f, 0};
      hinge.isometric = {all[own], {all[others[own][0]], all[others[own][1]], all[others[own][2]]}};
      hinge.own = narrow(x[own]);
      for (int k = 0; k < 3; ++k) hinge.p[k] = narrow(x[static_cast<std::size_t>(others[own][k])]);
      ForceAndBlock sum;
      IsometricQuadratic::add(hinge, 0, sum);
      CHECK(length(wide(sum.force) - force_by_differences(energy, x, own, 1e-3)) < 1e-5);
      CHECK(sum.block.xx == Approx(3 * all[own] * all[own]));
      CHECK(sum.block.xy == 0);
    }
  }
}

TEST_CASE("spring kernel: force and block where stretched, pressed, stitched and without a length", "[unit]") {
  const auto of = [](float rest_length, const Vec& apart, float damping = 0, float start = 0) {
    ForceAndBlock sum;
    add_spring({{0, 1, 1}, 8, rest_length, damping}, 1, damping, apart, start, sum);
    return sum;
  };
  const ForceAndBlock stretched = of(1, {2, 0, 0}), pressed = of(4, {2, 0, 0}), stitch = of(0, {0.5f, 0, 0}),
                      damped = of(2, {2, 0, 0}, 3, 1.5f);
  CHECK(stretched.force.x == -8);
  CHECK(stretched.block.xx == 8);
  CHECK(stretched.block.yy == 4);  // 1 − l₀/l = 1/2
  CHECK(pressed.force.x == 16);
  CHECK(pressed.block.yy == 0);
  CHECK(stitch.force.x == -4);
  CHECK(stitch.block.zz == 8);
  CHECK(damped.force.x == Approx(-8 * 3 * 0.5));
  CHECK(damped.block.xx == Approx(8 * 4));
  CHECK(of(0, {}).block.xx == 8);
  CHECK(of(1, {}).block.xx == 8);
  CHECK(of(1, {}).force.x == 0);
  CHECK(of(1, {1e-30f, 0, 0}).force.x == 0);
}

TEST_CASE("spring kernel: the ends of a stitch share its force by their weights, and feel w² k I", "[unit]") {
  const SpringRest stitch{{0, 1, 2}, 16, 0, 0, 0.25f};
  const Vec end[3] = {{0, 2, 0}, {-1, 0, 0}, {3, 0, 0}};
  const Vec apart = spring_apart(stitch, end);
  CHECK((apart.x == 0 && apart.y == 2 && apart.z == 0));
  const float weight[3] = {1, -0.75f, -0.25f};
  for (int end_of = 0; end_of < 3; ++end_of) {
    ForceAndBlock sum;
    CHECK(spring_weight(stitch, end_of) == weight[end_of]);
    add_spring(stitch, weight[end_of], 0, apart, 0, sum);
    CHECK(sum.force.y == -32 * weight[end_of]);
    CHECK(sum.block.xx == 16 * weight[end_of] * weight[end_of]);
    CHECK(sum.block.xy == 0);
  }
}

TEST_CASE("damping by vertex adds k times the elastic block, on the motion and to the block", "[unit]") {
  ForceAndBlock elastic, sum;
  elastic.add_force(1, {1, 2, 3});
  elastic.add_identity(2);
  elastic.add_outer(1, {0, 1, 1});
  add_damped_by_vertex(elastic, 0.5f, {4, 0, 2}, sum);
  // B = 2 I + (0,1,1)(0,1,1)ᵀ, B (4, 0, 2) = (8, 2, 6)
  CHECK(sum.force.x == 1 - 4);
  CHECK(sum.force.y == 2 - 1);
  CHECK(sum.force.z == 3 - 3);
  CHECK(sum.block.yy == 4.5f);
  CHECK(sum.block.yz == 1.5f);
}
