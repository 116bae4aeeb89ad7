// Compares the reference's friction with differences of the lagged potential, with mechanics and with closed forms.
#include "reference/energies/friction_force.hpp"

#include "tests/catch.hpp"
#include "tests/reference/energies/contacts.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::FrictionForceCase;

namespace {

compare::ForceAnswer exact(const FrictionForceCase& c) { return reference::friction_force(c).front(); }

FrictionForceCase random_friction(Draw& draw, ContactSides sides) {
  FrictionForceCase c;
  c.contact = random_contact(draw, sides);
  for (std::size_t k = 0; k < static_cast<std::size_t>(vertex_count(sides)); ++k) {
    const compare::Vec3f step = draw.in_box(0.1), x = c.contact.vertex[k];
    c.start[k] = {x.x + step.x, x.y + step.y, x.z + step.z};
  }
  c.friction = draw.single(0.1, 1);
  c.slip_limit = draw.single(0.01, 0.3);
  return c;
}

/// Returns f₀(y), with f₀' = f₁ (method.md §4.4), f₀(ε) = ε and ε = `limit`.
double potential(double y, double limit) {
  return y < limit ? y * y / limit - y * y * y / (3 * limit * limit) + limit / 3 : y;
}

/// Weights, normal and λ, which friction keeps constant.
struct Lagged {
  Weights weight{};
  Point normal{};
  double force = 0;

  explicit Lagged(const ContactForceCase& c) {
    const std::array<Point, 4> x = points(c.vertex);
    weight = weights(c.sides, x);
    const double d = distance_of(x, weight), h = 1e-6;
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t i = 0; i < 3; ++i) normal[i] += weight[k] * x[k][i] / d;
    force = d < c.contact_radius ? (activation(d - h, c.contact_radius, c.stiffness) -
                                    activation(d + h, c.contact_radius, c.stiffness)) /
                                       (2 * h)
                                 : 0;
  }
  /// Returns the tangential part of Σ w (x − xᵗ).
  Point slip(const FrictionForceCase& c, const std::array<Point, 4>& x) const {
    Point u{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(vertex_count(c.contact.sides)); ++k)
      for (std::size_t i = 0; i < 3; ++i) u[i] += weight[k] * (x[k][i] - point(c.start[k])[i]);
    const double along = inner(u, normal);
    for (std::size_t i = 0; i < 3; ++i) u[i] -= along * normal[i];
    return u;
  }
};

/// Returns a point 0.25 m above a large triangle; since the start, the point has slipped along x and moved up. λ = 2 N.
FrictionForceCase above(float slip, float lift) {
  FrictionForceCase c;
  c.contact.sides = ContactSides::point_triangle;
  c.contact.vertex = {{{2.5f, 5, 0.25f}, {0, 0, 0}, {10, 0, 0}, {0, 10, 0}}};
  c.contact.previous = c.contact.vertex;
  c.contact.contact_radius = 0.5f;
  c.contact.stiffness = 8;
  c.start = c.contact.vertex;
  c.start[0] = {2.5f - slip, 5, 0.25f - lift};
  c.friction = 0.5f;
  c.slip_limit = 0.125f;
  return c;
}

}  // namespace

TEST_CASE("the reference's friction is minus the slope of the potential with normal, weights and normal force held",
          "[property]") {
  Draw draw(1);
  for (int i = 0; i < 100; ++i) {
    FrictionForceCase c = random_friction(draw, all_sides[static_cast<std::size_t>(i) % 4]);
    const Lagged lagged(c.contact);
    for (c.contact.own = 0; c.contact.own < vertex_count(c.contact.sides); ++c.contact.own) {
      const auto own = static_cast<std::size_t>(c.contact.own);
      const auto energy = [&](const Point& at) {
        std::array<Point, 4> x = points(c.contact.vertex);
        x[own] = at;
        return c.friction * lagged.force * potential(norm(lagged.slip(c, x)), c.slip_limit);
      };
      const Point expected = slope(energy, point(c.contact.vertex[own]), 1e-6);
      const compare::Vec3 force = exact(c).force;
      REQUIRE(norm({force.x + expected[0], force.y + expected[1], force.z + expected[2]}) < 1e-6);
    }
  }
}

TEST_CASE("the reference's friction opposes the slip, never exceeds mu lambda, and leaves no net force", "[property]") {
  Draw draw(2);
  for (int i = 0; i < 200; ++i) {
    FrictionForceCase c = random_friction(draw, all_sides[static_cast<std::size_t>(i) % 4]);
    const Lagged lagged(c.contact);
    const Point u = lagged.slip(c, points(c.contact.vertex));
    Point total{};
    for (c.contact.own = 0; c.contact.own < vertex_count(c.contact.sides); ++c.contact.own) {
      const double w = lagged.weight[static_cast<std::size_t>(c.contact.own)];
      const compare::ForceAnswer answer = exact(c);
      const Point force{answer.force.x, answer.force.y, answer.force.z};
      REQUIRE(w * inner(force, u) <= 0);
      REQUIRE(norm(force) <= std::abs(w) * c.friction * lagged.force * (1 + 1e-6) + 1e-12);
      REQUIRE(std::abs(inner(force, lagged.normal)) < 1e-12);
      REQUIRE(smallest_quadratic(answer.block, draw) >= -1e-12);
      for (std::size_t k = 0; k < 3; ++k) total[k] += force[k];
    }
    REQUIRE(norm(total) < 1e-13);
  }
}

TEST_CASE(
    "friction is mu lambda (2 y - y^2) up to y = 1 slip limits and mu lambda beyond, whatever the motion along the "
    "normal",
    "[unit]") {
  for (const float lift : {0.0f, 0.5f, -3.0f}) {
    for (const double y : {0.0, 0.25, 0.5, 1.0, 2.0}) {
      const compare::ForceAnswer answer = exact(above(static_cast<float>(0.125 * y), lift));
      const double share = y < 1 ? 2 * y - y * y : 1;
      REQUIRE(answer.force.x == Approx(-1 * share).margin(1e-15));  // μ λ = 1 N
      REQUIRE(answer.force.y == Approx(0).margin(1e-15));
      REQUIRE(answer.force.z == Approx(0).margin(1e-15));
      const double stiffness = (y < 1 ? 2 - y : 1 / y) / 0.125;
      REQUIRE(answer.block[0] == Approx(stiffness));
      REQUIRE(answer.block[3] == Approx(stiffness));
      REQUIRE(answer.block[5] == Approx(0).margin(1e-12));
    }
  }
}

TEST_CASE("a common translation slips nothing", "[unit]") {
  FrictionForceCase c = above(0, 0);
  for (compare::Vec3f& x : c.start) x = {x.x + 1, x.y - 2, x.z + 3};
  for (c.contact.own = 0; c.contact.own < 4; ++c.contact.own) {
    const compare::Vec3 force = exact(c).force;
    REQUIRE(std::hypot(force.x, force.y, force.z) < 1e-14);
  }
}

TEST_CASE("no contact, no friction; at the radius both are accepted", "[unit]") {
  FrictionForceCase c = above(0.1f, 0);
  c.contact.contact_radius = 0.2f;
  REQUIRE(reference::friction_force(c).size() == 1);
  REQUIRE(exact(c).force == compare::Vec3{});
  c.contact.contact_radius = std::nextafter(0.25f, 1.0f);
  REQUIRE(reference::friction_force(c).size() == 2);
}

TEST_CASE(
    "a slip within 2^10 ulp of its limit lies near a decision, one beside it does not, nor one where nothing presses",
    "[unit]") {
  const auto near = [](float slip, float radius) {
    FrictionForceCase c = above(slip, 0);
    c.contact.contact_radius = radius;
    return reference::friction_force(compare::FrictionForceIn{{c}}).near[0] != 0;
  };
  constexpr float radius = 0.6f;  // neither r nor r/2 is 0.25
  for (const float slip : {0.125f, 0.125f * (1 + 0x1p-15f), 0.125f * (1 - 0x1p-15f)}) CHECK(near(slip, radius));
  for (const float slip : {0.0f, 0.1f, 0.124f, 0.126f, 0.2f}) CHECK_FALSE(near(slip, radius));
  CHECK_FALSE(near(0.125f, 0.2f));
}
