// Tests the tetrahedron's kernel against differences of its energy, in every shape, and its exact properties.
#include "fast/kernels/kinds/tetrahedron.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "fast/kernels/arithmetic/solve3.hpp"
#include "fast/kernels/rest_state.hpp"
#include "fast/stages/sweep.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using namespace ogc::fast;

namespace {

using SolidCorners = std::array<compare::Vec3, 4>;

const SolidCorners unit_corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
const SolidMaterial soft{3e4f, 1e4f, 0};

RestState rest_of(const SolidCorners& x) {
  const RestTetrahedron shape = rest_tetrahedron(x[0], x[1], x[2], x[3]);
  TetrahedronRest rest{
      {0, 1, 2, 3}, 0, {}, static_cast<float>(1 / (6 * shape.volume)), {}, static_cast<float>(shape.volume)};
  for (int i = 0; i < 6; ++i) rest.weight[i] = static_cast<float>(shape.weight[i]);
  for (int k = 0; k < 3; ++k) {
    rest.gradient[k][0] = static_cast<float>(shape.gradient[k + 1].x);
    rest.gradient[k][1] = static_cast<float>(shape.gradient[k + 1].y);
    rest.gradient[k][2] = static_cast<float>(shape.gradient[k + 1].z);
  }
  RestState state;
  state.tetrahedra = {rest};
  return state;
}

Vec single(const compare::Vec3& x) {
  return {static_cast<float>(x.x), static_cast<float>(x.y), static_cast<float>(x.z)};
}

/// Returns force and block of a corner.
ForceAndBlock seen_from(const RestState& state, const SolidMaterial& material, const SolidCorners& x,
                        const SolidCorners& start, int corner) {
  const std::vector<int> colours(4, 0);
  const TetrahedronIncidence seen = TetrahedronKind::seen(state.tetrahedra[0], 0, corner, {colours.data(), 0});
  const TetrahedronGradients gradients = TetrahedronKind::beside(state.tetrahedra[0], {}, corner);
  const auto to = [&](const SolidCorners& at, int k) {
    const compare::Vec3 &p = at[static_cast<std::size_t>(seen.index[k])], &own = at[static_cast<std::size_t>(corner)];
    return single({p.x - own.x, p.y - own.y, p.z - own.z});
  };
  ForceAndBlock sum;
  add_tetrahedron(seen.stencil, material, to(x, 0), to(x, 1), to(x, 2), sum);
  if (material.damping > 0)
    add_solid_damping(gradients, material, to(x, 0), to(x, 1), to(x, 2),
                      solid_strain(solid_deformation(gradients, to(start, 0), to(start, 1), to(start, 2))), sum);
  return sum;
}

/// Returns ψ by F = D D₀⁻¹ in double, with D and D₀ the edges from corner 0; it uses no part of the kernel.
double energy(const SolidCorners& rest, const SolidMaterial& material, const SolidCorners& x,
              const SolidCorners& start) {
  using Matrix = std::array<std::array<double, 3>, 3>;
  const auto edges = [](const SolidCorners& at) {
    Matrix d{};
    for (std::size_t k = 0; k < 3; ++k)
      d[k] = {at[k + 1].x - at[0].x, at[k + 1].y - at[0].y, at[k + 1].z - at[0].z};  // rows
    return d;
  };
  const auto cross = [](const auto& a, const auto& b) {
    return std::array<double, 3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const auto dot = [](const auto& a, const auto& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const Matrix d0 = edges(rest);
  const double six = dot(d0[0], cross(d0[1], d0[2]));
  const std::array<std::array<double, 3>, 3> gradient{cross(d0[1], d0[2]), cross(d0[2], d0[0]), cross(d0[0], d0[1])};
  const auto deformation = [&](const SolidCorners& at) {
    const Matrix d = edges(at);
    Matrix f{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) f[i][j] += d[k][i] * gradient[k][j] / six;
    return f;
  };
  const auto strain = [](const Matrix& f) {
    Matrix g{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t k = 0; k < 3; ++k) g[i][j] += 0.5 * f[k][i] * f[k][j];
        if (i == j) g[i][j] -= 0.5;
      }
    return g;
  };
  const Matrix f = deformation(x), g = strain(f), before = strain(deformation(start));
  const double j = dot(f[0], cross(f[1], f[2])), lambda = material.lame_lambda, mu = material.lame_mu;
  double squared = 0, change = 0, trace = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    trace += g[a][a] - before[a][a];
    for (std::size_t b = 0; b < 3; ++b) {
      squared += f[a][b] * f[a][b];
      change += (g[a][b] - before[a][b]) * (g[a][b] - before[a][b]);
    }
  }
  const double psi = 0.5 * mu * (squared - 3) - mu * (j - 1) + 0.5 * (lambda + mu) * (j - 1) * (j - 1);
  return six / 6 * (psi + material.damping * (0.5 * lambda * trace * trace + mu * change));
}

double& coordinate(SolidCorners& x, int corner, int axis) {
  compare::Vec3& p = x[static_cast<std::size_t>(corner)];
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

std::array<double, 3> numbers(const Vec& a) { return {a.x, a.y, a.z}; }

/// Returns random shapes: near rest, sheared, flat, inverted, needles.
SolidCorners random_shape(std::mt19937& random, int kind) {
  std::uniform_real_distribution<double> about(-1, 1);
  SolidCorners x = unit_corners;
  const double size = kind == 0 ? 0.01 : 0.7;
  for (compare::Vec3& p : x) p = {p.x + size * about(random), p.y + size * about(random), p.z + size * about(random)};
  if (kind == 2) x[3].z = x[0].z = x[1].z = x[2].z;
  if (kind == 3) std::swap(x[1], x[2]);
  if (kind == 4) x[2] = {x[1].x + 1e-3, x[1].y, x[1].z};
  for (compare::Vec3& p : x) {
    const Vec rounded = single(p);
    p = {rounded.x, rounded.y, rounded.z};
  }
  return x;
}

}  // namespace

TEST_CASE("a tetrahedron's force is minus the derivative of its energy in every shape, damping included",
          "[property]") {
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    const SolidCorners rest = i % 2 == 0 ? unit_corners : random_shape(random, 0), x = random_shape(random, i % 5),
                       start = random_shape(random, 0);
    const RestState state = rest_of(rest);
    for (const float damping : {0.0f, 0.5f}) {
      SolidMaterial material = soft;
      material.damping = damping;
      for (int corner = 0; corner < 4; ++corner) {
        const ForceAndBlock sum = seen_from(state, material, x, start, corner);
        for (int axis = 0; axis < 3; ++axis) {
          SolidCorners ahead = x, behind = x;
          constexpr double step = 1e-5;
          coordinate(ahead, corner, axis) += step, coordinate(behind, corner, axis) -= step;
          const double slope = (energy(rest, material, ahead, start) - energy(rest, material, behind, start)) /
                               (2 * step);
          // Stiffness times edge length is 4e4 N, and a few times that where F is large: 1e-5 of it, most of which is
          // single precision.
          CHECK(numbers(sum.force)[static_cast<std::size_t>(axis)] == Approx(-slope).margin(2));
        }
      }
    }
  }
}

TEST_CASE("a tetrahedron's block is the second derivative of the elastic energy, and positive definite", "[property]") {
  std::mt19937 random(2);
  for (int i = 0; i < 500; ++i) {
    const SolidCorners x = random_shape(random, i % 5);
    const RestState state = rest_of(unit_corners);
    for (int corner = 0; corner < 4; ++corner) {
      const Symmetric3 b = seen_from(state, soft, x, x, corner).block;
      const double diagonal[] = {b.xx, b.yy, b.zz};
      for (int axis = 0; axis < 3; ++axis) {
        SolidCorners ahead = x, behind = x;
        constexpr double step = 1e-3;  // J is affine in one vertex: the energy is quadratic, and no step too long
        coordinate(ahead, corner, axis) += step, coordinate(behind, corner, axis) -= step;
        const double bend = (energy(unit_corners, soft, ahead, x) - 2 * energy(unit_corners, soft, x, x) +
                             energy(unit_corners, soft, behind, x)) /
                            (step * step);
        CHECK(diagonal[axis] == Approx(bend).epsilon(1e-4));
      }
      // μ V ‖∇N‖² alone is positive: 1e4/6 and more on the unit tetrahedron
      const double least = 0.999 * soft.lame_mu / 6;
      const double minor = static_cast<double>(b.xx) * b.yy - static_cast<double>(b.xy) * b.xy;
      const double det = b.xx * (static_cast<double>(b.yy) * b.zz - static_cast<double>(b.yz) * b.yz) -
                         b.xy * (static_cast<double>(b.xy) * b.zz - static_cast<double>(b.yz) * b.xz) +
                         b.xz * (static_cast<double>(b.xy) * b.yz - static_cast<double>(b.yy) * b.xz);
      CHECK(b.xx >= least);
      CHECK(minor >= least * least);
      CHECK(det >= 0.99 * least * least * least);
    }
  }
}

TEST_CASE("a tetrahedron at rest has no force, nor has one that is turned and moved, and all forces add up to nothing",
          "[property]") {
  std::mt19937 random(3);
  const double s = std::sin(1.0), c = std::cos(1.0);
  const auto turned = [&](const compare::Vec3& p) {
    return compare::Vec3{c * p.x - s * p.y + 0.25, s * p.x + c * p.y, p.z};
  };
  for (int i = 0; i < 200; ++i) {
    const SolidCorners rest = random_shape(random, 0);
    const RestState state = rest_of(rest);
    SolidCorners moved;
    std::transform(rest.begin(), rest.end(), moved.begin(), turned);
    SolidMaterial damped = soft;
    damped.damping = 2;
    const SolidCorners shape = random_shape(random, i % 5);
    Vec total;
    for (int corner = 0; corner < 4; ++corner) {
      // u times stiffness and length, a few times: 6e-8 · 4e4 · 10
      for (const SolidCorners& x : {rest, moved})
        for (const double f : numbers(seen_from(state, damped, x, rest, corner).force)) CHECK(std::abs(f) < 0.05);
      total += seen_from(state, damped, shape, rest, corner).force;
    }
    for (const double f : numbers(total)) CHECK(std::abs(f) < 2);
  }
}

TEST_CASE("an inverted tetrahedron that is swept vertex by vertex recovers", "[property]") {
  const RestState state = rest_of(unit_corners);
  SolidCorners x = unit_corners;
  x[3].z = -0.4;
  CHECK(volume_ratio(state.tetrahedra[0], single(x[1]), single(x[2]), single(x[3])) < 0);
  for (int sweep = 0; sweep < 200; ++sweep)
    for (int corner = 0; corner < 4; ++corner) {
      const ForceAndBlock sum = seen_from(state, soft, x, x, corner);
      const Vec change = solve_symmetric(sum.block, sum.force, 1.0f);
      compare::Vec3& p = x[static_cast<std::size_t>(corner)];
      p = {p.x + change.x, p.y + change.y, p.z + change.z};
    }
  const auto to = [&](std::size_t k) { return single({x[k].x - x[0].x, x[k].y - x[0].y, x[k].z - x[0].z}); };
  CHECK(volume_ratio(state.tetrahedra[0], to(1), to(2), to(3)) == Approx(1).margin(1e-3));
  CHECK(energy(unit_corners, soft, x, x) < 1e-3);
}

TEST_CASE("the energy that is reported is that of F", "[unit]") {
  std::mt19937 random(4);
  for (int i = 0; i < 100; ++i) {
    const SolidCorners x = random_shape(random, i % 5);
    const auto to = [&](std::size_t k) { return single({x[k].x - x[0].x, x[k].y - x[0].y, x[k].z - x[0].z}); };
    const double reported = solid_energy(rest_of(unit_corners).tetrahedra[0], soft, to(1), to(2), to(3));
    CHECK(reported == Approx(energy(unit_corners, soft, x, x)).epsilon(1e-5).margin(1e-2));
  }
}
