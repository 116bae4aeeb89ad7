// Compares the reference's spring with differences of its energy and with mechanics, and tests the lengths at which its
// formula changes.
#include "reference/energies/spring.hpp"

#include "tests/catch.hpp"
#include "tests/reference/energies/stencils.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::SpringCase;

namespace {

SpringCase random_case(Draw& draw) {
  SpringCase c;
  for (auto* points : {&c.vertex, &c.start}) *points = {draw.in_box(1), draw.in_box(1), draw.in_box(1)};
  c.stiffness = draw.single(1, 20);
  c.rest_length = draw.single(0, 2);
  c.damping = draw.single(0, 2);
  return c;
}

double energy(const Point& own, const SpringCase& c) {
  const double length = norm(minus(own, point(c.vertex[1]))),
               before = norm(minus(point(c.start[0]), point(c.start[1])));
  return c.stiffness / 2 *
         ((length - c.rest_length) * (length - c.rest_length) + c.damping * (length - before) * (length - before));
}

/// Returns the energy of a stitch whose vertex `c.own` is at the position `own`.
double seam_energy(const Point& own, const SpringCase& c) {
  const auto length = [&](const std::array<compare::Vec3f, 3>& at, const Point* moved) {
    std::array<Point, 3> x{point(at[0]), point(at[1]), point(at[2])};
    if (moved != nullptr) x[static_cast<std::size_t>(c.own)] = *moved;
    Point apart{};
    for (std::size_t k = 0; k < 3; ++k)
      apart[k] = x[0][k] - (1 - double{c.ratio}) * x[1][k] - double{c.ratio} * x[2][k];
    return norm(apart);
  };
  const double now = length(c.vertex, &own), before = length(c.start, nullptr);
  return c.stiffness / 2 *
         ((now - c.rest_length) * (now - c.rest_length) + c.damping * (now - before) * (now - before));
}

Point force_of(const compare::ForceAnswer& answer) { return {answer.force.x, answer.force.y, answer.force.z}; }

}  // namespace

TEST_CASE("the reference's spring force is minus the slope of the energy, along the spring, and opposite at its ends",
          "[property]") {
  Draw draw(1);
  for (int i = 0; i < 200; ++i) {
    SpringCase c = random_case(draw);
    if (norm(minus(point(c.vertex[0]), point(c.vertex[1]))) < 0.1) continue;
    const Point force = force_of(reference::spring(c)),
                fallen = slope([&](const Point&x) { return energy(x, c); }, point(c.vertex[0]), 1e-5);
    // Third derivatives are below 10⁵ for lengths above 0.1 m, so truncation gives 10⁻¹⁰/6 · 10⁵. Energies of 100 J are
    // rounded: 100 · 2⁻⁵³/10⁻⁵.
    for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(force[k] + fallen[k]) < 1e-4);
    CHECK(norm(outer(force, minus(point(c.vertex[0]), point(c.vertex[1])))) < 1e-13 * (1 + norm(force)));
    std::swap(c.vertex[0], c.vertex[1]);
    std::swap(c.start[0], c.start[1]);
    const Point other = force_of(reference::spring(c));
    for (std::size_t k = 0; k < 3; ++k) CHECK(force[k] == Approx(-other[k]).margin(1e-13));
  }
}

TEST_CASE(
    "the reference's spring block is the second derivative where stretched, and positive semidefinite where pressed",
    "[property]") {
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

TEST_CASE("a spring to a point of an edge: its forces are minus the energy's slopes, their sum and their moment are 0",
          "[property]") {
  Draw draw(5);
  for (int i = 0; i < 200; ++i) {
    SpringCase c = random_case(draw);
    c.ratio = draw.single(0.01, 0.99);
    Point sum{}, moment{};
    double size = 0;
    for (c.own = 0; c.own < 3; ++c.own) {
      const auto own = static_cast<std::size_t>(c.own);
      const Point force = force_of(reference::spring(c)),
                  fallen = slope([&](const Point&x) { return seam_energy(x, c); }, point(c.vertex[own]), 1e-5);
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(std::abs(force[k] + fallen[k]) < 1e-3);  // energies as above, but lengths may be shorter than 0.1 m
        sum[k] += force[k];
        moment[k] += outer(point(c.vertex[own]), force)[k];
      }
      size += norm(force);
    }
    CHECK(norm(sum) < 1e-14 * size);
    CHECK(norm(moment) < 1e-13 * size);
  }
}

TEST_CASE("a stitch to a point of an edge has the blocks w² k I, and none is pulled where it is closed", "[unit]") {
  SpringCase c;
  c.vertex = {{{0, 0, 0}, {-1, 0, 0}, {3, 0, 0}}};
  c.start = c.vertex;
  c.stiffness = 16;
  c.ratio = 0.25f;
  const std::array<double, 3> weight{1, -0.75, -0.25};
  for (c.own = 0; c.own < 3; ++c.own) {
    const double w = weight[static_cast<std::size_t>(c.own)], block = w * w * 16;
    CHECK(reference::spring(c).force == compare::Vec3{});
    CHECK(reference::spring(c).block == std::array<double, 6>{block, 0, 0, block, 0, block});
    SpringCase open = c;
    open.vertex[0].y = 2;
    CHECK(reference::spring(open).force.y == -w * 32);
    CHECK(reference::spring(open).block[0] == Approx(block));
  }
}

TEST_CASE("a stitch is k I at every length, and a spring without a length exerts nothing", "[unit]") {
  SpringCase c;
  c.vertex = {{{0.25f, -1, 2}, {0, 0, 0}, {0, 0, 0}}};
  c.start = c.vertex;
  c.stiffness = 8;
  const compare::ForceAnswer stitch = reference::spring(c);
  CHECK(stitch.force == compare::Vec3{-2, 8, -16});
  for (std::size_t k = 0; k < 6; ++k)
    CHECK(stitch.block[k] == Approx(k == 0 || k == 3 || k == 5 ? 8.0 : 0.0).margin(1e-14));
  c.vertex[0] = {};
  CHECK(reference::spring(c).force == compare::Vec3{});
  CHECK(reference::spring(c).block == std::array<double, 6>{8, 0, 0, 8, 0, 8});
  c.rest_length = 1;
  CHECK(reference::spring(c).force == compare::Vec3{});
  CHECK(reference::spring(c).block == std::array<double, 6>{8, 0, 0, 8, 0, 8});
}

TEST_CASE(
    "without a length the block majorises the energy, whatever the rest length: no smaller multiple of I does for all",
    "[property]") {
  Draw draw(6);
  double nearest = 0;
  for (int i = 0; i < 200; ++i) {
    SpringCase c = random_case(draw);
    c.vertex = {};
    c.start = {};
    c.damping = 0;
    if (i % 4 == 0) c.rest_length = 0;
    const compare::ForceAnswer answer = reference::spring(c);
    CHECK(answer.force == compare::Vec3{});
    const Point moved = point(draw.in_box(1));
    const double risen = energy(moved, c) - energy({}, c), promised = answer.block[0] / 2 * norm(moved) * norm(moved);
    CHECK(risen <= promised * (1 + 1e-14) + 1e-14 * energy({}, c));
    nearest = std::max(nearest, risen / promised);
  }
  CHECK(nearest == Approx(1));
}

TEST_CASE("what a lost length leaves of a stitch's block is accepted, no block is not", "[property]") {
  SpringCase c;  // the vertex lies 10⁻⁸ beside the middle of an edge of length 1, a fifth of the rounding error
  c.vertex = {{{0.5f, 1e-8f, 0}, {0, 0, 0}, {1, 0, 0}}};
  c.start = c.vertex;
  c.stiffness = 16;
  c.ratio = 0.5f;
  for (const float rest_length : {0.0f, 1e-12f, 3e-12f}) {
    c.rest_length = rest_length;
    const compare::ForceAnswer answer = reference::spring(c);
    const double accepted = compare::spring_block_tolerance * compare::unit_roundoff * answer.block_scale;
    // If rounding makes the length 0, an answer's block lacks the multiple of I − n nᵀ, with n = e₂. `missing` is the
    // norm of this multiple, from its entries xx and zz.
    const double missing = std::sqrt(answer.block[0] * answer.block[0] + answer.block[5] * answer.block[5]);
    CHECK((missing <= accepted) == (rest_length > 0));
    CHECK(std::sqrt(missing * missing + answer.block[3] * answer.block[3]) > accepted);
  }
}

TEST_CASE("damping of a spring's strain sees no rigid motion, damping by vertex a translation, too", "[property]") {
  SpringCase c;
  c.vertex = {{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  c.start = {{{5, 1, 0}, {5, 0, 0}, {5, 0, 0}}};  // the spring has been rotated and moved, with the same length
  c.stiffness = 2;
  c.rest_length = 1;
  c.damping = 3;
  CHECK(reference::spring(c).force == compare::Vec3{});
  c.damping_form = compare::DampingForm::per_vertex;
  // The force is −k B Δ with B = k_s n nᵀ at rest length and Δ = (−4, −1, 0).
  CHECK(reference::spring(c).force.x == Approx(3 * 2 * 4));
  CHECK(reference::spring(c).force.y == Approx(0).margin(1e-14));
}
