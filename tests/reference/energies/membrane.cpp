// Compares the reference's membrane with differences of its energy, with mechanics, and with a stretch whose force has
// a closed form.
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

compare::ForceAnswer exact(const MembraneCase& c) { return reference::membrane(c).front(); }

MembraneCase neo_hookean(MembraneCase c) {
  c.model = compare::MembraneModel::stable_neo_hookean;
  return c;
}

using Strain = std::array<double, 3>;
using Columns = std::array<Point, 2>;

Columns columns(const std::array<Point, 3>& x, const MembraneCase& c) {
  Columns f{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double n1 = c.gradient[0][axis], n2 = c.gradient[1][axis], n = k == 0 ? -n1 - n2 : k == 1 ? n1 : n2;
      for (std::size_t i = 0; i < 3; ++i) f[axis][i] += n * x[k][i];
    }
  return f;
}

Strain strain(const Columns& f) {
  return {(inner(f[0], f[0]) - 1) / 2, inner(f[0], f[1]) / 2, (inner(f[1], f[1]) - 1) / 2};
}

double density(const Strain& g, const MembraneCase& c) {
  const double trace = g[0] + g[2];
  return c.lame_lambda / 2 * trace * trace + c.lame_mu * (g[0] * g[0] + 2 * g[1] * g[1] + g[2] * g[2]);
}

/// Returns the density from the singular values of F: μ/2 (s₁ − s₂)² + (λ + μ)/2 (s₁ s₂ − 1)².
double neo_hookean_density(const Columns& f, const MembraneCase& c) {
  const double squares = inner(f[0], f[0]) + inner(f[1], f[1]), product = norm(outer(f[0], f[1]));
  return c.lame_mu / 2 * (squares - 2 * product) +
         (double{c.lame_lambda} + c.lame_mu) / 2 * (product - 1) * (product - 1);
}

double energy(const Point& own, const MembraneCase& c) {
  const Columns f = columns({own, point(c.corner[1]), point(c.corner[2])}, c);
  const Strain now = strain(f), before = strain(columns({point(c.start[0]), point(c.start[1]), point(c.start[2])}, c));
  const double psi = c.model == compare::MembraneModel::stable_neo_hookean ? neo_hookean_density(f, c)
                                                                           : density(now, c);
  return c.area * (psi + c.damping * density({now[0] - before[0], now[1] - before[1], now[2] - before[2]}, c));
}

/// Returns the same stencil; its second corner becomes the first.
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
    const MembraneCase c = i % 2 == 0 ? random_case(draw) : neo_hookean(random_case(draw));
    const compare::ForceAnswer answer = exact(c);
    const Point fallen = slope([&](const Point& x) { return energy(x, c); }, point(c.corner[0]), 1e-5);
    // Energies reach 10⁵ J, so rounding gives 10⁵ · 2⁻⁵³ / 10⁻⁵ ≈ 10⁻⁶. Truncation of a quartic with third derivatives
    // of this size gives 10⁻¹⁰ · 10⁵.
    const double accepted = 1e-4 + 1e-8 * answer.force_scale;
    CHECK(std::abs(answer.force.x + fallen[0]) < accepted);
    CHECK(std::abs(answer.force.y + fallen[1]) < accepted);
    CHECK(std::abs(answer.force.z + fallen[2]) < accepted);
  }
}

TEST_CASE("the reference's membrane exerts no net force and, without damping, no net torque", "[property]") {
  Draw draw(2);
  for (int i = 0; i < 300; ++i) {
    MembraneCase c = i % 2 == 0 ? random_case(draw) : neo_hookean(random_case(draw));
    c.damping = 0;
    Point force{}, torque{};
    double scale = 0;
    for (int corner = 0; corner < 3; ++corner, c = turned(c)) {
      const compare::ForceAnswer answer = exact(c);
      const Point f{answer.force.x, answer.force.y, answer.force.z}, turn = outer(point(c.corner[0]), f);
      for (std::size_t k = 0; k < 3; ++k) {
        force[k] += f[k];
        torque[k] += turn[k];
      }
      scale += answer.force_scale;
    }
    // When another corner becomes the first, gradients are rounded to single precision again. Inputs with an error of
    // 2⁻²⁴ change a force by 2⁻²⁴ · force_scale. Lever arms are shorter than 3 m.
    CHECK(norm(force) < 4 * compare::unit_roundoff * scale);
    CHECK(norm(torque) < 12 * compare::unit_roundoff * scale);
  }
}

TEST_CASE("the reference's membrane block is positive semidefinite, also under compression", "[property]") {
  Draw draw(3);
  for (int i = 0; i < 200; ++i) {
    MembraneCase c = i % 4 < 2 ? random_case(draw) : neo_hookean(random_case(draw));
    if (i % 2 == 0)
      for (auto& p : c.corner) p = {0.3f * p.x, 0.3f * p.y, 0.3f * p.z};
    const compare::ForceAnswer answer = exact(c);
    CHECK(smallest_quadratic(answer.block, draw) >= -1e-12 * answer.block_scale);
  }
}

TEST_CASE("a uniform stretch of the reference's membrane has the force of its closed form", "[property]") {
  // Corners (0,0), (1,0), (0,1) are stretched to (s,0), (0,s). Then G = (s² − 1)/2 I and S = 2 (λ + μ) G. The force on
  // corner 0 is the sum of A F S ∇N₀, towards the inside.
  for (const float s : {0.5f, 1.0f, 1.25f, 2.0f}) {
    MembraneCase c;
    c.gradient = {{{1, 0}, {0, 1}}};
    c.area = 0.5f;
    c.corner = {{{0, 0, 0}, {s, 0, 0}, {0, s, 0}}};
    c.start = c.corner;
    c.lame_lambda = 3;
    c.lame_mu = 5;
    const double g = (double{s} * s - 1) / 2, expected = 0.5 * s * (2 * 3 + 2 * 5) * g;
    const compare::ForceAnswer answer = exact(c);
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
  CHECK(exact(c).force == compare::Vec3{});
  // Since the start of the step the triangle has been rotated rigidly: no strain, no damping.
  c.corner = {{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}}};
  CHECK(exact(c).force == compare::Vec3{});
  c.corner[0] = {-0.25f, 0, 0};
  c.corner[1] = {1, 0, 0};
  CHECK(exact(c).force.x > 0);
}

TEST_CASE("at rest the stable Neo-Hookean membrane exerts nothing, and answers small strains like the other model",
          "[property]") {
  MembraneCase c;
  c.gradient = {{{1, 0}, {0, 1}}};
  c.area = 0.5f;
  c.corner = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  c.start = c.corner;
  c.lame_lambda = 3;
  c.lame_mu = 5;
  CHECK(exact(neo_hookean(c)).force == compare::Vec3{});
  for (const std::size_t corner : {1u, 2u})
    for (const float small : {0x1p-10f, -0x1p-10f}) {
      MembraneCase moved = c;
      (corner == 1 ? moved.corner[1].x : moved.corner[2].x) += small;
      const compare::ForceAnswer a = exact(moved), b = exact(neo_hookean(moved));
      // The models agree to first order; the second-order difference is about small² times the stiffness.
      CHECK(std::hypot(a.force.x - b.force.x, a.force.y - b.force.y) < 20 * small * small);
      CHECK(std::hypot(a.force.x, a.force.y) > 0.5 * std::abs(small));
    }
}

TEST_CASE("a uniform stretch of the stable Neo-Hookean membrane has the force of its closed form", "[property]") {
  // Corners (0,0), (1,0), (0,1) are stretched to (s,0), (0,s). Then ψ = (λ + μ)/2 (s² − 1)² and ∂ψ/∂F = (λ + μ)(s² − 1)
  // s I. The force on corner 0 is A times the row sums of ∂ψ/∂F.
  for (const float s : {0.5f, 1.0f, 1.25f, 2.0f}) {
    MembraneCase c;
    c.gradient = {{{1, 0}, {0, 1}}};
    c.area = 0.5f;
    c.corner = {{{0, 0, 0}, {s, 0, 0}, {0, s, 0}}};
    c.start = c.corner;
    c.lame_lambda = 3;
    c.lame_mu = 5;
    const double expected = 0.5 * 8 * (double{s} * s - 1) * s;
    const compare::ForceAnswer answer = exact(neo_hookean(c));
    CHECK(answer.force.x == Approx(expected).margin(1e-14));
    CHECK(answer.force.y == Approx(expected).margin(1e-14));
    CHECK(answer.force.z == 0);
  }
}

TEST_CASE(
    "the stable Neo-Hookean block is the energy's second derivative where that is positive semidefinite, and never "
    "below it",
    "[property]") {
  Draw draw(5);
  int definite = 0;
  for (int i = 0; i < 200; ++i) {
    MembraneCase c = neo_hookean(random_case(draw));
    c.damping = 0;
    const std::array<double, 6> block = exact(c).block;
    const double step = 1e-4;
    std::array<double, 6> second{};
    for (std::size_t a = 0, k = 0; a < 3; ++a)
      for (std::size_t b = a; b < 3; ++b, ++k) {
        const auto at = [&](double s, double t) {
          Point x = point(c.corner[0]);
          x[a] += s * step;
          x[b] += t * step;
          return energy(x, c);
        };
        second[k] = (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4 * step * step);
      }
    const double size = std::abs(block[0]) + std::abs(block[3]) + std::abs(block[5]);
    std::array<double, 6> raised{};
    double largest = 0;
    for (std::size_t k = 0; k < 6; ++k)
      raised[k] = block[k] - second[k], largest = std::max(largest, std::abs(raised[k]));
    // Energies have the size of the block's entries. Second differences with steps of 10⁻⁴ have a rounding error of
    // 2⁻⁵³/10⁻⁸ of the energy, and a truncation error of 10⁻⁸ times fourth derivatives.
    CHECK(smallest_quadratic(raised, draw) >= -1e-4 * size);
    if (smallest_quadratic(second, draw) < 1e-3 * size) continue;
    ++definite;
    CHECK(largest <= 1e-4 * size);
  }
  CHECK(definite > 20);
}

TEST_CASE("a collapsed stable Neo-Hookean triangle is pulled together alone, and any normal is accepted",
          "[property]") {
  MembraneCase c;
  c.gradient = {{{1, 0}, {0, 1}}};
  c.area = 0.5f;
  c.corner = {{{0, 0, 0}, {1, 0, 0}, {0.5f, 0, 0}}};
  c.start = c.corner;
  c.lame_lambda = 3;
  c.lame_mu = 5;
  const auto answers = reference::membrane(neo_hookean(c));
  REQUIRE(answers.size() == 2);
  // The elastic force at J = 0 is −A μ F ∇N₀ = 0.5 · 5 · (f₁ + f₂), with f₁ = (1, 0, 0) and f₂ = (0.5, 0, 0). The term
  // −A ∂ψ/∂J ∂J/∂x₀ may have any direction normal to the triangle's line: ∂ψ/∂J = −(λ + 2μ) = −13 and ‖∂J/∂x₀‖ = ‖f₁ −
  // f₂‖ = 0.5.
  CHECK(answers[0].force.x == Approx(0.5 * 5 * 1.5));
  CHECK(answers[1].force.x == Approx(0.5 * 5 * 1.5));
  CHECK(compare::membrane_force_tolerance * compare::unit_roundoff * answers[1].force_scale >= 0.5 * 13 * 0.5);
  c.corner[2].y = 0.5f;
  CHECK(reference::membrane(neo_hookean(c)).size() == 1);
}

TEST_CASE("damping by vertex resists the vertex's own motion through its own block, even a translation", "[property]") {
  Draw draw(6);
  for (int i = 0; i < 100; ++i) {
    MembraneCase c = random_case(draw);
    if (i % 2 == 0) c = neo_hookean(c);
    MembraneCase elastic = c;
    elastic.damping = 0;
    c.damping_form = compare::DampingForm::per_vertex;
    const compare::ForceAnswer damped = exact(c), free = exact(elastic);
    const Point moved = minus(point(c.corner[0]), point(c.start[0]));
    const auto& b = free.block;
    const Point resisted{b[0] * moved[0] + b[1] * moved[1] + b[2] * moved[2],
                         b[1] * moved[0] + b[3] * moved[1] + b[4] * moved[2],
                         b[2] * moved[0] + b[4] * moved[1] + b[5] * moved[2]};
    CHECK(damped.force.x == Approx(free.force.x - c.damping * resisted[0]));
    CHECK(damped.force.z == Approx(free.force.z - c.damping * resisted[2]));
    for (std::size_t k = 0; k < 6; ++k) CHECK(damped.block[k] == Approx((1 + double{c.damping}) * b[k]).margin(1e-12));
  }
}

TEST_CASE("a membrane of no model exerts nothing", "[unit]") {
  Draw draw(7);
  MembraneCase c = random_case(draw);
  c.model = compare::MembraneModel::none;
  CHECK(exact(c).force == compare::Vec3{});
}
