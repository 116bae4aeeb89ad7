#include "fast/kernels/models/discrete_hinge.hpp"

#include "fast/kernels/rest_state.hpp"
#include "tests/catch.hpp"
#include "tests/fast/numeric.hpp"

using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

constexpr double u = 0x1p-24;

// Returns the angle between the two half planes, from their unit vectors across the edge. It is 0 if flat, and negative
// if o1 is on the side of (x1 − x0) × (o0 − x0).
double angle_of(const std::vector<D3>& x) {
  const D3 edge = (1 / length(x[1] - x[0])) * (x[1] - x[0]);
  const auto across = [&](const D3& p) {
    const D3 a = p - x[0], flat = a - dot(a, edge) * edge;
    return (1 / length(flat)) * flat;
  };
  const D3 a = across(x[2]), b = -across(x[3]);
  return std::atan2(dot(cross(a, b), edge), dot(a, b));
}

struct Case {
  std::vector<Vec> x;
  HingeStencil stencil{2e-4f, 0.2f};
  float damping = 0.4f, angle_start = -0.1f;

  std::vector<D3> wide_x() const { return {wide(x[0]), wide(x[1]), wide(x[2]), wide(x[3])}; }
  double energy(const std::vector<D3>& at) const {
    const double a = angle_of(at), from_rest = a - stencil.rest_angle, from_start = a - angle_start;
    return 0.5 * stencil.stiffness * (from_rest * from_rest + damping * from_start * from_start);
  }
  // Adds the hinge in the sweep's order: the vertex of this role is x0 if it is an end of the edge, else o0.
  ForceAndBlock add(std::size_t role) const {
    static constexpr std::size_t order[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {0, 1, 2, 3}, {1, 0, 3, 2}};
    const Vec x0 = x[order[role][0]], x1 = x[order[role][1]], a = x[order[role][2]], b = x[order[role][3]];
    const HingeShape shape = hinge_shape(x1 - x0, a - x0, b - x0);
    ForceAndBlock sum;
    if (shape.defined)
      DiscreteHinge::add(stencil, damping, shape.angle, angle_start, hinge_gradient(shape, role >= 2), sum);
    return sum;
  }
  // Returns a bound of the angle's gradient: one over the smaller height, enlarged for feet of heights that are off the
  // edge's ends.
  double steepness() const {
    const auto w = wide_x();
    const double e = length(w[1] - w[0]), ha = length(cross(w[1] - w[0], w[2] - w[0])) / e,
                 hb = length(cross(w[1] - w[0], w[3] - w[0])) / e;
    const double reach = std::max(length(w[2] - w[0]), length(w[3] - w[0])) / e;
    return (1 + reach) / std::min(ha, hb);
  }
  double conditioning() const {
    const auto w = wide_x();
    const double e = length(w[1] - w[0]);
    return std::max({1.0, e * steepness(), length(w[2] - w[0]) * steepness(), length(w[3] - w[0]) * steepness()});
  }
};

Case random_case(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Case c;
  do {
    c.x.clear();
    const RigidMotion motion(random, 0.1);
    const double bend = 0.5 * normal(random);
    const D3 corners[4] = {
        {0, 0, 0}, {0.01, 0, 0}, {0.004, 0.008, 0.008 * bend}, {0.006, -0.007, 0.003 * normal(random)}};
    for (const D3& p : corners)
      c.x.push_back(narrow(motion(p + 1e-3 * D3{normal(random), normal(random), normal(random)})));
  } while (c.conditioning() > 100);
  return c;
}

}  // namespace

TEST_CASE("the hinge's angle is that of the half planes, for every role", "[property]") {
  std::mt19937 random(21);
  for (int i = 0; i < 5000; ++i) {
    const Case c = random_case(random);
    const double exact = angle_of(c.wide_x());
    const float forward = hinge_shape(c.x[1] - c.x[0], c.x[2] - c.x[0], c.x[3] - c.x[0]).angle;
    const float backward = hinge_shape(c.x[0] - c.x[1], c.x[3] - c.x[1], c.x[2] - c.x[1]).angle;
    // Differences of coordinates below 1 m are exact in double, so the test has no input error. The kernel's
    // differences err by up to u = 2⁻²⁴ of a coordinate. The remaining error is 12 u of the sine, amplified by the
    // shape.
    REQUIRE(std::abs(forward - exact) <= 32 * u * c.conditioning());
    REQUIRE(std::abs(backward - exact) <= 32 * u * c.conditioning());
  }
}

TEST_CASE("hinge forces are the negative gradient of energy and damping, for every role", "[property]") {
  std::mt19937 random(22);
  for (int i = 0; i < 2000; ++i) {
    const Case c = random_case(random);
    for (std::size_t role = 0; role < 4; ++role) {
      const D3 expected = force_by_differences([&](const auto& at) { return c.energy(at); }, c.wide_x(), role, 1e-7);
      const double scale = c.stencil.stiffness * (1 + c.damping) * c.steepness();
      REQUIRE(length(wide(c.add(role).force) - expected) <= (48 * u * c.conditioning() + 1e-6) * scale);
    }
  }
}

TEST_CASE("the hinge's block is Gauss-Newton's", "[property]") {
  std::mt19937 random(23);
  for (int i = 0; i < 1000; ++i) {
    const Case c = random_case(random);
    for (std::size_t role = 0; role < 4; ++role) {
      const D3 gradient = force_by_differences([](const auto& at) { return -angle_of(at); }, c.wide_x(), role, 1e-7);
      std::array<double, 9> expected{};
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
          expected[static_cast<std::size_t>(3 * a + b)] = c.stencil.stiffness * (1 + c.damping) * axis(gradient, a) *
                                                          axis(gradient, b);
        }
      }
      const double scale = c.stencil.stiffness * (1 + c.damping) * c.steepness() * c.steepness();
      REQUIRE(largest_difference(dense(c.add(role).block), expected) <= (64 * u * c.conditioning() + 1e-5) * scale);
      REQUIRE(least_curvature(c.add(role).block, random) >= -64 * u * scale);
    }
  }
}

TEST_CASE("a hinge leaves no net force and no net torque", "[property]") {
  std::mt19937 random(24);
  for (int i = 0; i < 2000; ++i) {
    const Case c = random_case(random);
    D3 force, torque;
    double reach = 0;
    for (std::size_t role = 0; role < 4; ++role) {
      const D3 f = wide(c.add(role).force), arm = wide(c.x[role]) - wide(c.x[0]);
      force += f;
      torque += cross(arm, f);
      reach = std::max(reach, length(arm));
    }
    const double scale = c.stencil.stiffness * (1 + c.damping) * c.steepness();
    REQUIRE(length(force) <= 128 * u * c.conditioning() * scale);
    REQUIRE(length(torque) <= 128 * u * c.conditioning() * scale * reach);
  }
}

TEST_CASE("rest angle and present angle agree in sign and size", "[unit]") {
  const ogc::compare::Vec3 x0{0, 0, 0}, x1{1, 0, 0}, o0{0.5, 1, 0}, up{0.5, -1, 0.5}, down{0.5, -1, -0.5};
  const auto angle = [&](const ogc::compare::Vec3& o1) {
    return hinge_shape<float>({1, 0, 0}, {0.5f, 1, 0}, {0.5f, -1, static_cast<float>(o1.z)}).angle;
  };
  CHECK(rest_hinge(x0, x1, o0, up).angle == Approx(-std::atan(0.5)));
  CHECK(rest_hinge(x0, x1, o0, down).angle == Approx(std::atan(0.5)));
  CHECK(angle(up) == Approx(rest_hinge(x0, x1, o0, up).angle));
  CHECK(angle(down) == Approx(rest_hinge(x0, x1, o0, down).angle));
  CHECK(rest_hinge(x0, x1, o0, {0.5, -1, 0}).factor == Approx(3.0));  // ‖e‖ = 1, both areas are 1/2
}

TEST_CASE("a hinge with a collapsed triangle or edge exerts nothing", "[unit]") {
  CHECK_FALSE(hinge_shape<float>({1, 0, 0}, {0.5f, 0, 0}, {0.5f, -1, 0}).defined);
  CHECK_FALSE(hinge_shape<float>({1, 0, 0}, {0.5f, 1, 0}, {2, 0, 0}).defined);
  CHECK_FALSE(hinge_shape<float>({0, 0, 0}, {0.5f, 1, 0}, {0.5f, -1, 0}).defined);
  CHECK_FALSE(hinge_shape<float>({0.3f, 0.7f, 0.11f}, {0.15f, 0.35f, 0.055f}, {0.5f, -1, 0}).defined);
  CHECK(hinge_shape<float>({1, 0, 0}, {0.5f, 1e-3f, 0}, {0.5f, -1, 0}).defined);
}
