// Compares the reference's force of a volume with differences of its energy; weights, direction and normal force are
// fixed.
#include "reference/energies/volume_force.hpp"

#include "tests/catch.hpp"
#include "tests/reference/energies/contacts.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::VolumeForceCase;

namespace {

VolumeForceCase random_case(Draw& draw) {
  VolumeForceCase c;
  Point n = point(draw.in_box(1));
  const double length = std::sqrt(inner(n, n));
  for (std::size_t k = 0; k < 3; ++k) c.direction[k] = static_cast<float>(n[k] / length);
  c.weights = {0.5f, 0.375f, 0.125f};
  for (std::size_t k = 0; k < 4; ++k) {
    c.vertex[k] = draw.in_box(0.3);
    const compare::Vec3f step = draw.in_box(0.1), x = c.vertex[k];
    c.start[k] = {x.x + step.x, x.y + step.y, x.z + step.z};
  }
  c.contact_radius = draw.single(0.5, 1);
  c.stiffness = draw.single(1, 5);
  c.friction = draw.single(0.1, 1);
  c.slip_limit = draw.single(0.01, 0.3);
  return c;
}

double weight(const VolumeForceCase& c, std::size_t k) { return k == 0 ? 1 : -double{c.weights[k - 1]}; }

Point direction(const VolumeForceCase& c) { return {c.direction[0], c.direction[1], c.direction[2]}; }

double depth(const VolumeForceCase& c, const std::array<Point, 4>& x) {
  double height = 0;
  for (std::size_t k = 1; k < 4; ++k)
    for (std::size_t i = 0; i < 3; ++i) height += c.weights[k - 1] * direction(c)[i] * (x[0][i] - x[k][i]);
  return std::max(0.0, c.contact_radius - height);
}

/// Returns f₀(y), with f₀' = f₁ (method.md §4.4), f₀(ε) = ε and ε = `limit`.
double potential(double y, double limit) {
  return y < limit ? y * y / limit - y * y * y / (3 * limit * limit) + limit / 3 : y;
}

double energy(const VolumeForceCase& c, const std::array<Point, 4>& x) {
  const double pressed = depth(c, x), held = c.stiffness * depth(c, points(c.vertex));
  Point slip{};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 3; ++i) slip[i] += weight(c, k) * (x[k][i] - point(c.start[k])[i]);
  const double along = inner(slip, direction(c));
  for (std::size_t i = 0; i < 3; ++i) slip[i] -= along * direction(c)[i];
  return 0.5 * c.stiffness * pressed * pressed +
         c.friction * held * potential(std::sqrt(inner(slip, slip)), c.slip_limit);
}

}  // namespace

TEST_CASE("the reference's force of a volume is minus the slope of its energy", "[property]") {
  Draw draw(61);
  for (int n = 0; n < 200; ++n) {
    VolumeForceCase c = random_case(draw);
    for (std::int32_t own = 0; own < 4; ++own) {
      c.own = own;
      const compare::ForceAnswer exact = reference::volume_force(c).front();
      const std::array<double, 3> force{exact.force.x, exact.force.y, exact.force.z};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        constexpr double step = 1e-6;
        std::array<Point, 4> above = points(c.vertex), below = above;
        above[static_cast<std::size_t>(own)][axis] += step;
        below[static_cast<std::size_t>(own)][axis] -= step;
        // Third derivatives of μ λ f₀ are at most 2 μ λ/ε², with μ λ ≤ 10 N, so truncation gives 2e5 step². Energies of
        // 10 J are rounded by 2⁻⁵² · 10 J; the difference divides this error by the step.
        REQUIRE(std::abs(force[axis] + (energy(c, above) - energy(c, below)) / (2 * step)) <= 1e-6);
      }
    }
  }
}

TEST_CASE("at phi = r both the block of a contact and none are accepted", "[unit]") {
  VolumeForceCase c;
  c.vertex = {{{0.25f, 0.25f, 0.5f}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  c.start = c.vertex;
  c.weights = {0.5f, 0.25f, 0.25f};
  c.direction = {0, 0, 1};
  c.contact_radius = 0.5f;
  c.stiffness = 8;
  c.slip_limit = 0.125f;
  const auto accepted = reference::volume_force(c);
  REQUIRE(accepted.size() == 2);
  CHECK(accepted[0].block[5] == 0);
  CHECK(accepted[1].block[5] == 8);
  c.vertex[0].z = 0.25f;
  c.start[0].z = 0.25f;
  CHECK(reference::volume_force(c).size() == 1);
  CHECK(reference::volume_force(c)[0].force.z == 2);
  CHECK(reference::volume_force(c)[0].block[5] == 8);
  c.vertex[0].z = -0.25f;  // inside
  CHECK(reference::volume_force(c)[0].force.z == 6);
  c.vertex[0].z = 0.75f;
  CHECK(reference::volume_force(c)[0].block[5] == 0);
}
