// The spring of the reference against differences of its energy, mechanics, and the lengths at which it changes over.
#include "reference/energies/spring.hpp"

#include "tests/catch.hpp"
#include "tests/reference/energies/stencils.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::SpringCase;

namespace {

SpringCase random_case(Draw& draw) {
  SpringCase c;
  for (auto* points : {&c.vertex, &c.start}) *points = {draw.in_box(1), draw.in_box(1)};
  c.stiffness = draw.single(1, 20);
  c.rest_length = draw.single(0, 2);
  c.damping = draw.single(0, 2);
  return c;
}

double energy(const Point& own, const SpringCase& c) {
  const double length = norm(minus(own, point(c.vertex[1]))), before = norm(minus(point(c.start[0]), point(c.start[1])));
  return c.stiffness / 2 * ((length - c.rest_length) * (length - c.rest_length) + c.damping * (length - before) * (length - before));
}

Point force_of(const compare::ForceAnswer& answer) { return {answer.force.x, answer.force.y, answer.force.z}; }

}  // namespace

TEST_CASE("the reference's spring force is minus the slope of the energy, along the spring, and opposite at its ends", "[property]") {
  Draw draw(1);
  for (int i = 0; i < 200; ++i) {
    SpringCase c = random_case(draw);
    if (norm(minus(point(c.vertex[0]), point(c.vertex[1]))) < 0.1) continue;
    const Point force = force_of(reference::spring(c)), fallen = slope([&](const Point& x) { return energy(x, c); }, point(c.vertex[0]), 1e-5);
    // Energies of some 100 J with third derivatives below 10⁵ at lengths above 0.1 m.
    for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(force[k] + fallen[k]) < 1e-4);
    CHECK(norm(outer(force, minus(point(c.vertex[0]), point(c.vertex[1])))) < 1e-13 * (1 + norm(force)));
    std::swap(c.vertex[0], c.vertex[1]);
    std::swap(c.start[0], c.start[1]);
    const Point other = force_of(reference::spring(c));
    for (std::size_t k = 0; k < 3; ++k) CHECK(force[k] == Approx(-other[k]).margin(1e-13));
  }
}

TEST_CASE("the reference's spring block is the second derivative where stretched, and positive semidefinite where pressed", "[property]") {
  Draw draw(2);
  for (int i = 0; i < 200; ++i) {
    SpringCase c = random_case(draw);
    c.damping = 0;
    const double length = norm(minus(point(c.vertex[0]), point(c.vertex[1])));
    const compare::ForceAnswer answer = reference::spring(c);
    CHECK(smallest_quadratic(answer.block, draw) >= -1e-12 * answer.block_scale);
    if (length < 0.2 || length < c.rest_length) continue;
    const double step = 1e-4;
    Point ahead = point(c.vertex[0]), behind = ahead;
    ahead[0] += step;
    behind[0] -= step;
    const double second = (energy(ahead, c) - 2 * energy(point(c.vertex[0]), c) + energy(behind, c)) / (step * step);
    CHECK(answer.block[0] == Approx(second).epsilon(1e-4).margin(1e-4));
  }
}

TEST_CASE("a stitch is k I at every length, and a spring without a length exerts nothing", "[unit]") {
  SpringCase c;
  c.vertex = {{{0.25f, -1, 2}, {0, 0, 0}}};
  c.start = c.vertex;
  c.stiffness = 8;
  const compare::ForceAnswer stitch = reference::spring(c);
  CHECK(stitch.force == compare::Vec3{-2, 8, -16});
  for (std::size_t k = 0; k < 6; ++k) CHECK(stitch.block[k] == Approx(k == 0 || k == 3 || k == 5 ? 8.0 : 0.0).margin(1e-14));
  c.vertex[0] = {};
  CHECK(reference::spring(c).force == compare::Vec3{});
  CHECK(reference::spring(c).block == std::array<double, 6>{8, 0, 0, 8, 0, 8});
  c.rest_length = 1;
  CHECK(reference::spring(c).force == compare::Vec3{});
  CHECK(reference::spring(c).block == std::array<double, 6>{});
}

TEST_CASE("damping of a spring's strain sees no rigid motion, damping by vertex a translation, too", "[property]") {
  SpringCase c;
  c.vertex = {{{1, 0, 0}, {0, 0, 0}}};
  c.start = {{{5, 1, 0}, {5, 0, 0}}};  // turned and shifted, as long
  c.stiffness = 2;
  c.rest_length = 1;
  c.damping = 3;
  CHECK(reference::spring(c).force == compare::Vec3{});
  c.damping_form = compare::DampingForm::per_vertex;
  CHECK(reference::spring(c).force.x == Approx(3 * 2 * 4));  // −k B moved, B = k_s n nᵀ at rest length, moved = (−4, −1, 0)
  CHECK(reference::spring(c).force.y == Approx(0).margin(1e-14));
}
