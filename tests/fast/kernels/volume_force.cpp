#include "fast/kernels/volume_force.hpp"

#include "tests/catch.hpp"
#include "tests/fast/numeric.hpp"

using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

constexpr double u = 0x1p-24;
constexpr float radius = 0.01f, limit = 1e-4f;

struct Placed {
  VolumeContact contact;
  std::vector<Vec> x, start;
};

/// Returns a point at `height` above a point of a random triangle, along a random normal.
Placed random_contact(std::mt19937& random, float height) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<float> unit(0, 1);
  const D3 n{normal(random), normal(random), normal(random)};
  Placed p;
  const float s = unit(random), t = unit(random);
  p.contact = {{1 - s, s * (1 - t), s * t}, narrow((1 / length(n)) * n), 20, 0.4f};
  p.x.resize(4);
  Vec c;
  for (int k = 1; k < 4; ++k) {
    p.x[static_cast<std::size_t>(k)] = 0.05f * Vec{unit(random), unit(random), unit(random)};
    c = c + p.contact.weights[k - 1] * p.x[static_cast<std::size_t>(k)];
  }
  p.x[0] = c + height * p.contact.normal;
  for (const Vec& x : p.x) p.start.push_back(x - 1e-4f * Vec{unit(random), unit(random), unit(random)});
  return p;
}

ForceAndBlock of(const Placed& p, int role, float friction) {
  VolumeContact contact = p.contact;
  contact.friction = friction;
  ForceAndBlock sum;
  add_volume_contact(contact, p.x.data(), p.start.data(), role, radius, limit, sum);
  return sum;
}

/// Returns φ with fixed weights and n.
double height(const Placed& p, const std::vector<D3>& x) {
  double sum = 0;
  for (std::size_t k = 1; k < 4; ++k) sum += p.contact.weights[k - 1] * dot(wide(p.contact.normal), x[0] - x[k]);
  return sum;
}

std::vector<D3> wide_points(const Placed& p) {
  std::vector<D3> all;
  for (const Vec& x : p.x) all.push_back(wide(x));
  return all;
}

}  // namespace

TEST_CASE("the normal force of a volume is minus the slope of k/2 (r - phi)^2, inside and outside alike",
          "[property]") {
  std::mt19937 random(51);
  for (int i = 0; i < 500; ++i) {
    const Placed p = random_contact(random, radius * (0.9f - 0.01f * static_cast<float>(i)));
    const auto energy = [&](const std::vector<D3>& x) {
      const double depth = std::max(0.0, radius - height(p, x));
      return 0.5 * p.contact.stiffness * depth * depth;
    };
    for (int role = 0; role < 4; ++role) {
      const D3 difference = wide(of(p, role, 0).force) -
                            force_by_differences(energy, wide_points(p), static_cast<std::size_t>(role), 1e-6);
      // φ is a sum of products of lengths of at most 0.1 m, so it errs by 8 u (u = 2⁻²⁴), and the force by k times
      // this. Differences are exact for a parabola.
      REQUIRE(length(difference) <= 20 * (16 * u * 0.2 + 1e-9));
    }
  }
}

TEST_CASE("at the surface the force of a volume is k r from both sides", "[unit]") {
  for (const float height : {-1e-7f, 0.0f, 1e-7f}) {
    Placed p;
    p.contact = {{0.25f, 0.25f, 0.5f}, {0, 0, 1}, 20, 0};
    p.x = {{0.5f, 0.25f, height}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    p.start = p.x;
    CHECK(of(p, 0, 0).force.z == Approx(20 * 0.01).epsilon(1e-4));
    CHECK(of(p, 0, 0).block.zz == Approx(20));
  }
}

TEST_CASE("beyond r a volume does nothing", "[unit]") {
  std::mt19937 random(52);
  for (int i = 0; i < 100; ++i) {
    const Placed p = random_contact(random, 1.001f * radius);
    for (int role = 0; role < 4; ++role) {
      const ForceAndBlock none = of(p, role, 0.4f);
      REQUIRE(length(none.force) == 0);
      REQUIRE(none.block.xx + none.block.yy + none.block.zz == 0);
    }
  }
}

TEST_CASE("forces of a contact with a volume add up to nothing, and blocks are positive semidefinite", "[property]") {
  std::mt19937 random(53);
  for (int i = 0; i < 500; ++i) {
    const Placed p = random_contact(random, radius * (0.9f - 0.02f * static_cast<float>(i)));
    D3 sum{};
    double size = 0;
    for (int role = 0; role < 4; ++role) {
      const ForceAndBlock at = of(p, role, 0.4f);
      sum = sum + wide(at.force);
      size += length(at.force);
      REQUIRE(least_curvature(at.block, random) >= -8 * u * (at.block.xx + at.block.yy + at.block.zz));
    }
    // The weights' sum is 1 up to 2 · 2⁻²⁴, and each force is rounded a few times.
    REQUIRE(length(sum) <= 8 * u * size);
  }
}

TEST_CASE("friction of a driven volume carries along: the slip is that of the point against the volume", "[unit]") {
  Placed p;
  p.contact = {{0.25f, 0.25f, 0.5f}, {0, 0, 1}, 20, 0.4f};
  p.x = {{0.5f, 0.25f, -0.01f}, {0.01f, 0, 0}, {0.01f, 1, 0}, {1.01f, 0, 0}};
  p.start = {{0.5f, 0.25f, -0.01f}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  // The volume has moved by 0.01 m along x, far beyond ε_v h: μ λ = 0.4 · 20 · 0.02 N along x acts on the point.
  CHECK(of(p, 0, 0.4f).force.x == Approx(0.16).epsilon(1e-4));
  p.start[0].x -= 0.01f;  // the point moves with the volume
  CHECK(std::abs(of(p, 0, 0.4f).force.x) <= 0.16 * 2 * 1e-3);
}
