// The membrane of the reference against differences of its energy, against mechanics, and against a stretch that has a closed form.
#include "reference/energies/membrane.hpp"

#include "tests/catch.hpp"
#include "tests/reference/energies/stencils.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::MembraneCase;

namespace {

MembraneCase random_case(Draw& draw) {
  MembraneCase c;
  const double b = draw.between(0.5, 1.5), cx = draw.between(-0.5, 1), h = draw.between(0.5, 1.5);
  c.gradient = {{{static_cast<float>(1 / b), static_cast<float>(-cx / (b * h))}, {0, static_cast<float>(1 / h)}}};
  c.area = static_cast<float>(b * h / 2);
  for (auto* points : {&c.corner, &c.start}) *points = {draw.in_box(0.2), draw.in_box(1.5), draw.in_box(1.5)};
  c.lame_lambda = draw.single(0, 20);
  c.lame_mu = draw.single(1, 20);
  c.damping = draw.single(0, 2);
  return c;
}

using Strain = std::array<double, 3>;

Strain strain(const std::array<Point, 3>& x, const MembraneCase& c) {
  std::array<Point, 2> f{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double n1 = c.gradient[0][axis], n2 = c.gradient[1][axis], n = k == 0 ? -n1 - n2 : k == 1 ? n1 : n2;
      for (std::size_t i = 0; i < 3; ++i) f[axis][i] += n * x[k][i];
    }
  return {(inner(f[0], f[0]) - 1) / 2, inner(f[0], f[1]) / 2, (inner(f[1], f[1]) - 1) / 2};
}

double density(const Strain& g, const MembraneCase& c) {
  const double trace = g[0] + g[2];
  return c.lame_lambda / 2 * trace * trace + c.lame_mu * (g[0] * g[0] + 2 * g[1] * g[1] + g[2] * g[2]);
}

double energy(const Point& own, const MembraneCase& c) {
  const Strain now = strain({own, point(c.corner[1]), point(c.corner[2])}, c), before = strain({point(c.start[0]), point(c.start[1]), point(c.start[2])}, c);
  return c.area * (density(now, c) + c.damping * density({now[0] - before[0], now[1] - before[1], now[2] - before[2]}, c));
}

/// The same stencil asked about its next corner.
MembraneCase turned(const MembraneCase& c) {
  MembraneCase next = c;
  for (std::size_t k = 0; k < 3; ++k) {
    next.corner[k] = c.corner[(k + 1) % 3];
    next.start[k] = c.start[(k + 1) % 3];
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    next.gradient[0][axis] = c.gradient[1][axis];
    next.gradient[1][axis] = -c.gradient[0][axis] - c.gradient[1][axis];
  }
  return next;
}

}  // namespace

TEST_CASE("the reference's membrane force is minus the slope of the energy", "[property]") {
  Draw draw(1);
  for (int i = 0; i < 300; ++i) {
    const MembraneCase c = random_case(draw);
    const compare::ForceAnswer answer = reference::membrane(c);
    const Point fallen = slope([&](const Point& x) { return energy(x, c); }, point(c.corner[0]), 1e-5);
    // Energies up to 10⁵ J: rounding 10⁵ · 2⁻⁵³ / 10⁻⁵ ≈ 10⁻⁶; a quartic with third derivatives of that size leaves 10⁻¹⁰ · 10⁵.
    const double accepted = 1e-4 + 1e-8 * answer.force_scale;
    CHECK(std::abs(answer.force.x + fallen[0]) < accepted);
    CHECK(std::abs(answer.force.y + fallen[1]) < accepted);
    CHECK(std::abs(answer.force.z + fallen[2]) < accepted);
  }
}

TEST_CASE("the reference's membrane exerts no net force and, without damping, no net torque", "[property]") {
  Draw draw(2);
  for (int i = 0; i < 300; ++i) {
    MembraneCase c = random_case(draw);
    c.damping = 0;
    Point force{}, torque{};
    double scale = 0;
    for (int corner = 0; corner < 3; ++corner, c = turned(c)) {
      const compare::ForceAnswer answer = reference::membrane(c);
      const Point f{answer.force.x, answer.force.y, answer.force.z}, turn = outer(point(c.corner[0]), f);
      for (std::size_t k = 0; k < 3; ++k) {
        force[k] += f[k];
        torque[k] += turn[k];
      }
      scale += answer.force_scale;
    }
    // Gradients of a turned stencil are rounded to single once more: an error of u in an input, one unit of the condition; arms are shorter than 3 m.
    CHECK(norm(force) < 4 * compare::unit_roundoff * scale);
    CHECK(norm(torque) < 12 * compare::unit_roundoff * scale);
  }
}

TEST_CASE("the reference's membrane block is positive semidefinite, also under compression", "[property]") {
  Draw draw(3);
  for (int i = 0; i < 200; ++i) {
    MembraneCase c = random_case(draw);
    if (i % 2 == 0)
      for (auto& p : c.corner) p = {0.3f * p.x, 0.3f * p.y, 0.3f * p.z};
    const compare::ForceAnswer answer = reference::membrane(c);
    CHECK(smallest_quadratic(answer.block, draw) >= -1e-12 * answer.block_scale);
  }
}

TEST_CASE("a uniform stretch of the reference's membrane has the force of its closed form", "[property]") {
  // Corners (0,0), (1,0), (0,1) stretched to (s,0), (0,s): G = (s² − 1)/2 I, S = 2 (λ + μ) G, force on corner 0: A F S ∇N₀ summed, towards the inside.
  for (const float s : {0.5f, 1.0f, 1.25f, 2.0f}) {
    MembraneCase c;
    c.gradient = {{{1, 0}, {0, 1}}};
    c.area = 0.5f;
    c.corner = {{{0, 0, 0}, {s, 0, 0}, {0, s, 0}}};
    c.start = c.corner;
    c.lame_lambda = 3;
    c.lame_mu = 5;
    const double g = (double{s} * s - 1) / 2, expected = 0.5 * s * (2 * 3 + 2 * 5) * g;
    const compare::ForceAnswer answer = reference::membrane(c);
    CHECK(answer.force.x == Approx(expected).margin(1e-15));
    CHECK(answer.force.y == Approx(expected).margin(1e-15));
    CHECK(answer.force.z == 0);
  }
}

TEST_CASE("the reference's membrane at rest exerts nothing, and damping resists a change alone", "[property]") {
  MembraneCase c;
  c.gradient = {{{1, 0}, {0, 1}}};
  c.area = 0.5f;
  c.corner = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  c.start = c.corner;
  c.lame_lambda = c.lame_mu = 4;
  c.damping = 3;
  CHECK(reference::membrane(c).force == compare::Vec3{});
  // Turned as a whole since the start of the step: no strain, no damping.
  c.corner = {{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}}};
  CHECK(reference::membrane(c).force == compare::Vec3{});
  c.corner[0] = {-0.25f, 0, 0};
  c.corner[1] = {1, 0, 0};
  CHECK(reference::membrane(c).force.x > 0);
}
