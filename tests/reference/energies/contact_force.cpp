// Compares the reference's contact with differences of its energy, with mechanics and with closed forms, and tests
// cases with several accepted answers.
#include "reference/energies/contact_force.hpp"

#include "tests/catch.hpp"
#include "tests/reference/energies/contacts.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

compare::ForceAnswer exact(const ContactForceCase& c) { return reference::contact_force(c).front(); }

/// Returns a point above a large triangle; the weights of the second and third corner are a quarter and a half.
ContactForceCase above(float height, float r = 0.5f, float k = 8) {
  ContactForceCase c;
  c.sides = ContactSides::point_triangle;
  c.vertex = {{{2.5f, 5, height}, {0, 0, 0}, {10, 0, 0}, {0, 10, 0}}};
  c.previous = c.vertex;
  c.contact_radius = r;
  c.stiffness = k;
  return c;
}

double trace(const compare::ForceAnswer& a) { return a.block[0] + a.block[3] + a.block[5]; }

}  // namespace

TEST_CASE(
    "the reference's contact force is minus the slope of the energy of the closest distance, weights that move "
    "included",
    "[property]") {
  Draw draw(1);
  for (int i = 0; i < 60; ++i) {
    ContactForceCase c = random_contact(draw, all_sides[static_cast<std::size_t>(i) % 4]);
    for (c.own = 0; c.own < vertex_count(c.sides); ++c.own) {
      const auto energy = [&](const Point& own) {
        std::array<Point, 4> x = points(c.vertex);
        x[static_cast<std::size_t>(c.own)] = own;
        return activation(distance_of(x, weights(c.sides, x)), c.contact_radius, c.stiffness);
      };
      const Point expected = slope(energy, point(c.vertex[static_cast<std::size_t>(c.own)]), 1e-5);
      const compare::Vec3 force = exact(c).force;
      REQUIRE(norm({force.x + expected[0], force.y + expected[1], force.z + expected[2]}) < 1e-6);
    }
  }
}

TEST_CASE("the reference's contact forces leave no net force and no net torque", "[property]") {
  Draw draw(2);
  for (int i = 0; i < 200; ++i) {
    ContactForceCase c = random_contact(draw, all_sides[static_cast<std::size_t>(i) % 4]);
    Point force{}, torque{};
    for (c.own = 0; c.own < vertex_count(c.sides); ++c.own) {
      const compare::Vec3 f = exact(c).force;
      const Point one{f.x, f.y, f.z}, turning = outer(point(c.vertex[static_cast<std::size_t>(c.own)]), one);
      for (std::size_t k = 0; k < 3; ++k) {
        force[k] += one[k];
        torque[k] += turning[k];
      }
    }
    REQUIRE(norm(force) < 1e-13);
    REQUIRE(norm(torque) < 1e-13);
  }
}

TEST_CASE("the reference's contact block is g'' w^2 n n^T: along the force, positive semidefinite, of rank one",
          "[property]") {
  Draw draw(3);
  for (int i = 0; i < 200; ++i) {
    ContactForceCase c = random_contact(draw, all_sides[static_cast<std::size_t>(i) % 4]);
    c.own = i / 4 % vertex_count(c.sides);
    const std::array<Point, 4> x = points(c.vertex);
    const Weights w = weights(c.sides, x);
    const double d = distance_of(x, w), weight = w[static_cast<std::size_t>(c.own)], r = c.contact_radius;
    const compare::ForceAnswer answer = exact(c);
    const double curvature = d < r / 2 ? c.stiffness * r * r / (4 * d * d) : c.stiffness;
    REQUIRE(trace(answer) == Approx(curvature * weight * weight).margin(1e-9));
    const double size = std::hypot(answer.force.x, answer.force.y, answer.force.z);
    if (size < 1e-6) continue;
    const std::array<double, 3> n{answer.force.x / size, answer.force.y / size, answer.force.z / size};
    constexpr std::array<std::array<std::size_t, 2>, 6> at{{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
    for (std::size_t k = 0; k < 6; ++k)
      REQUIRE(answer.block[k] == Approx(trace(answer) * n[at[k][0]] * n[at[k][1]]).margin(1e-9));
    REQUIRE(smallest_quadratic(answer.block, draw) >= -1e-12);
  }
}

TEST_CASE("blocks of vertices that are updated together majorise what the contact couples", "[property]") {
  Draw draw(4);
  for (int i = 0; i < 200; ++i) {
    ContactForceCase c = random_contact(draw, all_sides[static_cast<std::size_t>(i) % 4]);
    c.together = static_cast<std::uint8_t>(1 + i / 4 % 15);
    const std::array<Point, 4> x = points(c.vertex);
    const Weights w = weights(c.sides, x);
    double whole = 0, sum = 0, coupled = 0, blocks = 0;
    for (c.own = 0; c.own < vertex_count(c.sides); ++c.own) {
      if ((c.together >> c.own & 1) == 0) continue;
      const double weight = w[static_cast<std::size_t>(c.own)];
      ContactForceCase alone = c;
      alone.together = 0;
      if (weight != 0) whole = trace(exact(alone)) / (weight * weight);
      sum += std::abs(weight);
    }
    for (c.own = 0; c.own < vertex_count(c.sides); ++c.own) {
      if ((c.together >> c.own & 1) == 0) continue;
      const double weight = w[static_cast<std::size_t>(c.own)], step = draw.single(-1, 1);
      coupled += weight * step;
      blocks += trace(exact(c)) * step * step;
      REQUIRE(trace(exact(c)) == Approx(whole * std::abs(weight) * sum).margin(1e-9 * whole));
    }
    REQUIRE(blocks >= whole * coupled * coupled - 1e-9 * whole);
  }
}

TEST_CASE(
    "a point above a large triangle is pushed by k (r - d), below r/2 by k r^2/(4 d), and the corners share the "
    "reaction",
    "[unit]") {
  for (const float d : {0.0625f, 0.125f, 0.25f, 0.375f}) {
    ContactForceCase c = above(d);
    const double lambda = d < 0.25f ? 8 * 0.25 / (4 * double{d}) : 8 * (0.5 - double{d});
    REQUIRE(exact(c).force.z == Approx(lambda));
    REQUIRE(trace(exact(c)) == Approx(d < 0.25f ? lambda / double{d} : 8));
    constexpr std::array<double, 3> shares{0.25, 0.25, 0.5};
    for (c.own = 1; c.own < 4; ++c.own)
      REQUIRE(exact(c).force.z == Approx(-lambda * shares[static_cast<std::size_t>(c.own) - 1]));
  }
}

TEST_CASE("from r on there is no force, and the block is that at r, however far away", "[unit]") {
  using enum compare::ContactActivation;
  for (const float d : {0.5f, std::nextafter(0.5f, 1.0f), 0.51f, 2.0f, 1e4f})
    for (const compare::ContactActivation activation : {ogc, ogc_as_printed, quadratic, ipc_log, cubic}) {
      ContactForceCase c = above(d);
      c.activation = activation;
      const std::vector<compare::ForceAnswer> accepted = reference::contact_force(c);
      REQUIRE(accepted.size() == 1);
      const bool is_flat = activation == ipc_log || activation == cubic;
      CHECK(exact(c).force == compare::Vec3{});
      CHECK(exact(c).block == std::array<double, 6>{0, 0, 0, 0, 0, is_flat ? 0.0 : 8.0});
      if (d > 0.505f) CHECK(exact(c).force_scale == 0);
    }
}

TEST_CASE("at 0 nothing acts, and nearer than 2^-23 r nothing grows", "[unit]") {
  REQUIRE(exact(above(0)).force == compare::Vec3{});
  REQUIRE(trace(exact(above(0))) == 0);
  ContactForceCase c;
  c.sides = ContactSides::point_point;
  c.contact_radius = 0.5f;
  c.stiffness = 8;
  for (const float d : {0x1p-24f, 0x1p-26f, 0x1p-40f}) {
    c.vertex[0].x = d;
    REQUIRE(exact(c).force.x == Approx(8 * 0.5 / (4 * 0x1p-23)));
    REQUIRE(trace(exact(c)) == Approx(8 / (4 * 0x1p-46)));
  }
}

TEST_CASE("the mollifier is that of the last detection, for two edges of meshes with triangles", "[unit]") {
  ContactForceCase c;
  c.sides = ContactSides::edge_edge;
  c.vertex = {{{-1, 0, 0.25f}, {1, 0, 0.25f}, {0, -1, 0}, {0, 1, 0}}};
  c.contact_radius = 1;
  c.stiffness = 2;
  const auto at = [&](double sine) {
    c.previous = {{{-1, 0, 0},
                   {1, 0, 0},
                   {0, 0, 0},
                   {static_cast<float>(2 * std::sqrt(1 - sine * sine)), static_cast<float>(2 * sine), 0}}};
    return exact(c).force.z;
  };
  c.rest_squared = {4, 0};
  REQUIRE(at(0) == Approx(1));  // λ/2 on each of the four ends
  c.rest_squared = {4, 4};
  REQUIRE(at(0) == 0);
  REQUIRE(at(std::sqrt(1e-3 / 2)) == Approx(0.75).epsilon(1e-6));
  REQUIRE(at(std::sqrt(1.001e-3)) == Approx(1));
}

TEST_CASE("two edges without triangles share the energy by their overlap where they were nearly parallel", "[unit]") {
  ContactForceCase c;
  c.sides = ContactSides::edge_edge;
  c.vertex = {{{-1, 0, 0.25f}, {1, 0, 0.25f}, {0, -1, 0}, {0, 1, 0}}};
  c.contact_radius = 1;
  c.stiffness = 2;
  const auto at = [&](float begin, float end, float slope) {
    c.previous = {{{0, 0, 0}, {4, 0, 0}, {begin, 0, 1}, {end, slope * (end - begin), 1}}};
    return exact(c).force.z;
  };
  for (const float slope : {0.0f, 1e-12f, 5e-4f}) {
    REQUIRE(at(3, 5, slope) == Approx(0.5));  // half of the shorter edge, the second
    REQUIRE(at(5, 3, slope) == Approx(0.5));
    REQUIRE(at(1, 2, slope) == Approx(1));      // all of the second
    REQUIRE(at(-2, 6, slope) == Approx(1));     // all of the first
    REQUIRE(at(-2, 3, slope) == Approx(0.75));  // three quarters of the first
  }
  REQUIRE(at(4, 6, 0) == Approx(1));      // the projections share only a point, so the edges are not nearly parallel
  REQUIRE(at(3, 5, 0.01f) == Approx(1));  // not nearly parallel
  c.rest_squared = {4, 0};
  REQUIRE(at(3, 5, 0) == Approx(1));
}

TEST_CASE("nearly parallel edges meet in the middle of their overlap", "[unit]") {
  ContactForceCase c;
  c.sides = ContactSides::edge_edge;
  c.vertex = {{{0, 0, 0}, {1, 0, 0}, {0.5f, 0, 0.25f}, {2.5f, 0, 0.25f}}};
  c.previous = c.vertex;
  c.rest_squared = {1, 0};
  c.contact_radius = 1;
  c.stiffness = 2;
  constexpr std::array<double, 4> shares{-0.25, -0.75, 0.875, 0.125};
  for (c.own = 0; c.own < 4; ++c.own) REQUIRE(exact(c).force.z == Approx(2 * shares[static_cast<std::size_t>(c.own)]));
}

TEST_CASE("where a decision is grey both answers are accepted, the exact one first", "[unit]") {
  REQUIRE(reference::contact_force(above(0.3f)).size() == 1);
  const auto at_radius = reference::contact_force(above(std::nextafter(0.5f, 0.0f)));
  REQUIRE(at_radius.size() == 1);  // force and block do not jump at r
  REQUIRE(at_radius[0].force_scale > 0);
  ContactForceCase beside = above(0.3f);
  beside.vertex[0] = {5, 5, 0.3f};  // above the middle of the side between the second and the third corner
  beside.own = 1;
  const auto on_side = reference::contact_force(beside);
  REQUIRE(on_side.size() == 2);
  REQUIRE(on_side[0].force.z == 0);
  // Rounding hides whether the point touches the triangle. So every force up to the force at the distance 2^-23 r is
  // accepted.
  REQUIRE(reference::contact_force(above(1e-7f)).size() == 2);
}

TEST_CASE("of a needle no force is accepted that is larger than at the exact distance, and of other shapes none at all",
          "[unit]") {
  ContactForceCase c = above(0.3f);
  c.vertex = {{{5, 0.005f, 0.3f}, {0, 0, 0}, {10, 0, 0}, {5, 0.01f, 0}}};
  const auto needle = reference::contact_force(c);
  REQUIRE(needle.size() == 2);
  CHECK(needle[1].force == compare::Vec3{});
  // The accepted error of the force is k (r − d), with the exact distance d = 0.3. The accepted error of the block is
  // k.
  CHECK(compare::contact_force_tolerance * compare::unit_roundoff * needle[1].force_scale ==
        Approx(8 * (0.5 - 0.3)).epsilon(1e-4));
  CHECK(compare::contact_block_tolerance * compare::unit_roundoff * needle[1].block_scale == Approx(8).epsilon(1e-4));
  c.vertex[3].y = 0.1f;
  c.vertex[0].y = 0.03f;
  CHECK(reference::contact_force(c).size() == 1);
  c.sides = ContactSides::edge_edge;
  c.vertex = {{{-5, 0, 0}, {5, 0, 0}, {0.1f, 0, 0.3f}, {0.1f, 0.01f, 0.3f}}};
  CHECK(reference::contact_force(c).back().force_scale > 0);
  CHECK(reference::contact_force(c).back().force == compare::Vec3{});
}
