// Compares the reference's rod with differences of its energy in plain doubles. Checks that its orientations are
// minimisers on the sphere: no orientation near or far has less energy, and M q + b = μ q with μ ≥ σ.
#include <algorithm>
#include <limits>

#include "reference/energies/rods/orientation.hpp"
#include "reference/energies/rods/rod.hpp"
#include "tests/catch.hpp"
#include "tests/reference/energies/stencils.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::OrientationAnswer;
using compare::OrientationCase;
using compare::Quaternion;
using compare::RodCase;
using compare::RodNeighbour;

namespace {

using Four = std::array<double, 4>;

Quaternion orientation(Draw& draw) {
  Four q;
  double squared = 0;
  for (double& x : q) x = draw.between(-1, 1), squared += x * x;
  Quaternion single;
  for (std::size_t k = 0; k < 4; ++k) single[k] = static_cast<float>(q[k] / std::sqrt(squared));
  return single;
}

/// Returns the rows of the rotation matrix of q.
std::array<Point, 3> matrix_of(const Quaternion& q) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
           {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
           {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
}

RodCase random_rod(Draw& draw) {
  RodCase c;
  c.vertex = {draw.in_box(1), draw.in_box(1)};
  c.start = {draw.in_box(1), draw.in_box(1)};
  c.orientation = orientation(draw);
  c.orientation_start = orientation(draw);
  c.rest_length = draw.single(0.5, 1);
  c.stretch = draw.single(1, 5);
  c.damping = draw.single(0.1, 2);
  return c;
}

/// Returns k_s l/2 (‖D/l − R e₃‖² + k ‖Rᵀ D/l − Rᵗᵀ Dᵗ/l‖²) with the segment's end `own` at x.
double energy(const RodCase& c, const Point& x) {
  const auto other = point(c.vertex[static_cast<std::size_t>(1 - c.own)]);
  const Point d = c.own == 1 ? minus(x, other) : minus(other, x), before = minus(point(c.start[1]), point(c.start[0]));
  const auto r = matrix_of(c.orientation), start = matrix_of(c.orientation_start);
  double strain = 0, change = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double here = d[i] / c.rest_length - r[i][2];
    strain += here * here;
    double moved = 0;
    for (std::size_t k = 0; k < 3; ++k) moved += r[k][i] * d[k] - start[k][i] * before[k];
    change += moved * moved / (c.rest_length * c.rest_length);
  }
  return 0.5 * c.stretch * c.rest_length * (strain + c.damping * change);
}

OrientationCase random_segment(Draw& draw) {
  OrientationCase c;
  c.vertex = {draw.in_box(1), draw.in_box(1)};
  c.start = {draw.in_box(1), draw.in_box(1)};
  c.orientation = orientation(draw);
  c.orientation_start = orientation(draw);
  c.rest_length = draw.single(0.5, 1);
  c.stretch = draw.single(0.1, 2);
  c.damping = draw.between(0, 1) < 0.5 ? 0 : draw.single(0.1, 2);
  for (RodNeighbour* f : {&c.behind, &c.ahead})
    *f = {draw.single(0.1, 4), orientation(draw), orientation(draw), orientation(draw)};
  return c;
}

double energy(const OrientationAnswer& answer, const Four& q) {
  double all = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    all -= answer.vector[i] * q[i];
    for (std::size_t k = 0; k < 4; ++k) all -= 0.5 * q[i] * answer.matrix[i][k] * q[k];
  }
  return all;
}

double size(const Four& q) { return std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]); }

/// Returns the angle θ of the rotation from a segment to its neighbour, relative to the rotation at rest. Uses only the
/// trace of a product of matrices.
double angle_to(const OrientationCase& c, const Quaternion& q, bool is_ahead) {
  const RodNeighbour& f = is_ahead ? c.ahead : c.behind;
  const auto a = matrix_of(is_ahead ? q : f.now), b = matrix_of(is_ahead ? f.now : q), p = matrix_of(f.rest);
  double trace = 0;  // trace of (aᵀ b) pᵀ
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) trace += a[k][i] * b[k][j] * p[i][j];
  return std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0));
}

/// Returns k_s l/2 ‖D/l − R e₃‖² plus w (1 − cos θ/2) for each neighbour, with the neighbour's `weight` w and angle θ.
double physical_energy(const OrientationCase& c, const Quaternion& q) {
  const auto r = matrix_of(q);
  const Point d = minus(point(c.vertex[1]), point(c.vertex[0]));
  double strain = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double here = d[i] / c.rest_length - r[i][2];
    strain += here * here;
  }
  double all = 0.5 * c.stretch * c.rest_length * strain;
  for (const bool is_ahead : {false, true}) {
    const double weight = (is_ahead ? c.ahead : c.behind).weight;
    all += weight * (1 - std::cos(angle_to(c, q, is_ahead) / 2));
  }
  return all;
}

}  // namespace

TEST_CASE("the reference's force of a rod is minus the slope of its energy, its block the second derivative",
          "[property]") {
  Draw draw(71);
  for (int n = 0; n < 300; ++n) {
    RodCase c = random_rod(draw);
    for (std::int32_t own = 0; own < 2; ++own) {
      c.own = own;
      const compare::ForceAnswer exact = reference::rod(c);
      const Point x = point(c.vertex[static_cast<std::size_t>(own)]),
                  by_differences = slope([&](const Point&at) { return energy(c, at); }, x, 1e-3);
      // The energy is quadratic in x, so differences have no truncation error. Energies of 200 J are rounded by 2⁻⁵³ ·
      // 200 J; the difference divides this error by the step. Quaternions have length 1 up to 2⁻²³, which changes
      // forces of at most 300 N.
      CHECK(std::abs(exact.force.x + by_differences[0]) <= 1e-4);
      CHECK(std::abs(exact.force.y + by_differences[1]) <= 1e-4);
      CHECK(std::abs(exact.force.z + by_differences[2]) <= 1e-4);
      const double stiffness = c.stretch * (1 + double{c.damping}) / c.rest_length;
      for (const std::size_t k : {0u, 3u, 5u}) CHECK(exact.block[k] == Approx(stiffness).epsilon(1e-12));
      for (const std::size_t k : {1u, 2u, 4u}) CHECK(exact.block[k] == Approx(0).margin(1e-12));
    }
  }
}

TEST_CASE("a rigid motion meets no force of a rod that rested, elastic or viscous", "[property]") {
  Draw draw(72);
  for (int n = 0; n < 200; ++n) {
    RodCase c = random_rod(draw);
    const auto along = [&](const Quaternion& q) {
      const auto r = matrix_of(q);
      return compare::Vec3f{static_cast<float>(c.rest_length * r[0][2]), static_cast<float>(c.rest_length * r[1][2]),
                            static_cast<float>(c.rest_length * r[2][2])};
    };
    c.vertex = {compare::Vec3f{}, along(c.orientation)};
    c.start = {compare::Vec3f{}, along(c.orientation_start)};
    const compare::ForceAnswer exact = reference::rod(c);
    // Rounded coordinates and quaternions leave a force of at most 2⁻²² k_s (1 + k), and k_s (1 + k) is at most 15 N.
    CHECK(std::hypot(exact.force.x, exact.force.y, exact.force.z) <= 15 * 0x1p-22);
  }
}

TEST_CASE("an orientation's truth is the global minimiser: M q + b = mu q with mu at least sigma", "[property]") {
  Draw draw(73);
  for (int n = 0; n < 2000; ++n) {
    const OrientationAnswer exact = reference::orientation(random_segment(draw)).front();
    const Four& q = exact.orientation;
    CHECK(size(q) == Approx(1).epsilon(1e-14));
    Four pull = exact.vector;
    double sigma = 0, multiplier = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 4; ++k) pull[i] += exact.matrix[i][k] * q[k];
      multiplier += pull[i] * q[i];
      sigma += exact.matrix[0][i] * exact.matrix[0][i];
    }
    sigma = std::sqrt(sigma);  // M² = σ² I
    for (std::size_t i = 0; i < 4; ++i) CHECK(pull[i] == Approx(multiplier * q[i]).margin(1e-13 * exact.energy_scale));
    CHECK(multiplier >= sigma * (1 - 1e-13));
    CHECK(energy(exact, q) == Approx(exact.energy).epsilon(1e-12));
    for (int other = 0; other < 50; ++other) {
      const Quaternion p = orientation(draw);
      CHECK(energy(exact, {p[0], p[1], p[2], p[3]}) >= exact.energy - 1e-6 * exact.energy_scale);
    }
  }
}

TEST_CASE("from a near old q it minimises the energy of stretch, shear, bend and twist of rotation matrices",
          "[property]") {
  Draw draw(74);
  int compared = 0;
  for (int n = 0; n < 2000; ++n) {
    OrientationCase c = random_segment(draw);
    c.damping = 0;
    const Four q = reference::orientation(c).front().orientation;
    for (std::size_t k = 0; k < 4; ++k) c.orientation[k] = static_cast<float>(q[k]);
    // Solves again with q as the old orientation, which decides the signs of the neighbours' terms. If a sign changes,
    // so does the result. Then q does not minimise the physical energy, and the case is skipped.
    const Four again = reference::orientation(c).front().orientation;
    if (std::abs(again[0] - q[0]) + std::abs(again[1] - q[1]) + std::abs(again[2] - q[2]) + std::abs(again[3] - q[3]) >
        1e-5)
      continue;
    // Skips cases in which the rotation angle θ to a neighbour is near π. Beyond π the sign of the neighbour's term
    // changes, and the energy may be lower.
    if (std::max(angle_to(c, c.orientation, false), angle_to(c, c.orientation, true)) > 2.9) continue;
    ++compared;
    const double least = physical_energy(c, c.orientation);
    for (int other = 0; other < 20; ++other) {
      Quaternion p = c.orientation;
      double squared = 0;
      for (float& x : p) x += draw.single(-0.03, 0.03), squared += double{x} * x;
      for (float& x : p) x = static_cast<float>(x / std::sqrt(squared));
      CHECK(physical_energy(c, p) >= least - 1e-5);
    }
  }
  CHECK(compared > 1000);
}

TEST_CASE("where neighbours ask for nothing the frame turns about nothing but what the director asks", "[unit]") {
  OrientationCase c;
  c.vertex = {{{0, 0, 0}, {1, 0, 0}}};
  c.start = c.vertex;
  c.orientation = {0, 0, 0, 1};
  c.orientation_start = c.orientation;
  c.rest_length = 1;
  c.stretch = 2;
  // A rotation by π/2 about e₂ takes e₃ to e₁.
  const Four q = reference::orientation(c).front().orientation;
  CHECK(q[1] == Approx(std::sqrt(0.5)).epsilon(1e-12));
  CHECK(q[3] == Approx(std::sqrt(0.5)).epsilon(1e-12));
  c.vertex[1] = {0, 0, 0};  // D = 0: no energy depends on the orientation
  CHECK(reference::orientation(c).front().orientation == Four{0, 0, 0, 1});
}

TEST_CASE("a grey sign has two answers, and a reversed director none that stands alone", "[unit]") {
  OrientationCase c;
  c.vertex = {{{0, 0, 0}, {0, 0, 1}}};
  c.start = c.vertex;
  c.orientation = {0, 0, 0, 1};
  c.orientation_start = c.orientation;
  c.rest_length = 1;
  c.stretch = 2;
  c.ahead = {1, {0, 0, 1, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};  // a twist by π
  const auto both = reference::orientation(c);
  REQUIRE(both.size() == 2);
  CHECK(both[0].orientation[2] == Approx(1));
  CHECK(both[1].orientation[2] == Approx(-1));
  c.ahead.now = {1, 0, 0, 0};  // a rotation by π reverses the director; the stretch opposes it
  c.orientation = {0.6f, 0, 0, 0.8f};
  CHECK(std::isinf(reference::orientation(c).front().scale));
  c.ahead.weight = 100;  // this neighbour overcomes the stretch
  CHECK(reference::orientation(c).front().orientation[0] == Approx(1));
  CHECK(reference::orientation(c).front().scale < 10);
}
