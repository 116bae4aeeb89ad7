#include "fast/kernels/models/st_venant_kirchhoff.hpp"

#include "fast/kernels/rest_state.hpp"
#include "tests/catch.hpp"
#include "tests/fast/numeric.hpp"

using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

constexpr double u = 0x1p-24;

// Returns G by its definition from the single-precision gradients in double: G_ij = (f_i·f_j − δ_ij)/2.
std::array<double, 3> strain_of(const TriangleRest& rest, const std::vector<D3>& x) {
  D3 f[2];
  for (int column = 0; column < 2; ++column) {
    for (std::size_t k = 1; k < 3; ++k) f[column] += static_cast<double>(rest.gradient[k][column]) * (x[k] - x[0]);
  }
  return {(dot(f[0], f[0]) - 1) / 2, dot(f[0], f[1]) / 2, (dot(f[1], f[1]) - 1) / 2};
}

double quadratic_form(const SurfaceMaterial& m, double area, const std::array<double, 3>& g) {
  return area * (m.lame_lambda / 2.0 * (g[0] + g[2]) * (g[0] + g[2]) +
                 m.lame_mu * (g[0] * g[0] + 2 * g[1] * g[1] + g[2] * g[2]));
}

struct Case {
  TriangleRest rest;
  SurfaceMaterial material;
  std::vector<Vec> x, start;

  std::vector<D3> wide_x() const { return {wide(x[0]), wide(x[1]), wide(x[2])}; }
  double energy(const std::vector<D3>& at) const {
    const auto g = strain_of(rest, at), g0 = strain_of(rest, {wide(start[0]), wide(start[1]), wide(start[2])});
    return quadratic_form(material, rest.area, g) +
           material.membrane_damping * quadratic_form(material, rest.area, {g[0] - g0[0], g[1] - g0[1], g[2] - g0[2]});
  }
  ForceAndBlock add(int corner) const {
    const int b = (corner + 1) % 3, c = (corner + 2) % 3;
    const MembraneStencil stencil{
        {rest.gradient[b][0], rest.gradient[b][1]}, {rest.gradient[c][0], rest.gradient[c][1]}, rest.area};
    const Symmetric2 before = green_strain(
        deformation_gradient(start[1] - start[0], start[2] - start[0], rest.gradient[1], rest.gradient[2]));
    ForceAndBlock sum;
    const auto own = static_cast<std::size_t>(corner);
    StVenantKirchhoff::add(stencil, material, x[static_cast<std::size_t>(b)] - x[own],
                           x[static_cast<std::size_t>(c)] - x[own], before, sum);
    return sum;
  }
  // Returns the scale of a force's rounding error: a strain error u (1 + ‖F‖²), times stiffness, ‖F‖ and the largest
  // ‖∇N‖.
  double force_scale() const {
    double stretch = 0, gradient = 0;
    for (int k = 0; k < 3; ++k)
      gradient = std::max<double>(gradient, std::hypot(rest.gradient[k][0], rest.gradient[k][1]));
    for (std::size_t k = 1; k < 3; ++k) stretch += gradient * length(x[k] - x[0]);
    return rest.area * (material.lame_lambda + 2 * material.lame_mu) * (1 + material.membrane_damping) * gradient *
           stretch * (1 + stretch * stretch);
  }
};

Case random_case(std::mt19937& random, double deformation) {
  std::normal_distribution<double> normal;
  ogc::compare::Vec3 p[3];
  for (auto& corner : p) corner = {0.01 * normal(random), 0.01 * normal(random), 0.01 * normal(random)};
  const RestTriangle shape = rest_triangle(p[0], p[1], p[2]);
  Case c;
  c.rest.area = static_cast<float>(shape.area);
  for (int k = 0; k < 3; ++k) {
    for (int a = 0; a < 2; ++a) c.rest.gradient[k][a] = static_cast<float>(shape.gradient[k][a]);
  }
  c.material = {10, 7, 0.3f, 0};
  const RigidMotion motion(random, 0.1);
  for (const auto& corner : p) {
    const auto moved = [&] {
      return narrow(motion({corner.x, corner.y, corner.z}) +
                    deformation * D3{normal(random), normal(random), normal(random)});
    };
    c.x.push_back(moved());
    c.start.push_back(moved());
  }
  return c;
}

}  // namespace

TEST_CASE("membrane forces are the negative gradient of energy and damping", "[property]") {
  std::mt19937 random(11);
  for (int i = 0; i < 2000; ++i) {
    const Case c = random_case(random, i % 2 == 0 ? 1e-3 : 2e-2);
    for (int corner = 0; corner < 3; ++corner) {
      const D3 expected = force_by_differences([&](const auto& at) { return c.energy(at); }, c.wide_x(),
                                               static_cast<std::size_t>(corner), 1e-7);
      // 24 u (u = 2⁻²⁴): 6 roundings of the strain, 4 of the stress and 6 of the products with F and b, each of terms
      // of this size. 1e-8: error of the differences.
      REQUIRE(length(wide(c.add(corner).force) - expected) <= (24 * u + 1e-8) * c.force_scale());
    }
  }
}

TEST_CASE("the membrane's block is its material part plus the clamped geometric one", "[property]") {
  std::mt19937 random(12);
  for (int i = 0; i < 2000; ++i) {
    const Case c = random_case(random, i % 2 == 0 ? 1e-3 : 2e-2);
    const double h = 1e-7;
    std::array<std::array<double, 3>, 3> dg;
    for (int k = 0; k < 3; ++k) {
      auto above = c.wide_x(), below = c.wide_x();
      axis(above[0], k) += h;
      axis(below[0], k) -= h;
      const auto ga = strain_of(c.rest, above), gb = strain_of(c.rest, below);
      for (std::size_t j = 0; j < 3; ++j) dg[static_cast<std::size_t>(k)][j] = (ga[j] - gb[j]) / (2 * h);
    }
    const auto g = strain_of(c.rest, c.wide_x());
    const double bx = c.rest.gradient[0][0], by = c.rest.gradient[0][1], l = c.material.lame_lambda,
                 m = c.material.lame_mu;
    const double geometric = bx * bx * (l * (g[0] + g[2]) + 2 * m * g[0]) + 2 * bx * by * 2 * m * g[1] +
                             by * by * (l * (g[0] + g[2]) + 2 * m * g[2]);
    std::array<double, 9> expected{};
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) {
        const double trace = (dg[a][0] + dg[a][2]) * (dg[b][0] + dg[b][2]);
        const double product = dg[a][0] * dg[b][0] + 2 * dg[a][1] * dg[b][1] + dg[a][2] * dg[b][2];
        expected[3 * a + b] = c.rest.area * (1 + c.material.membrane_damping) * (l * trace + 2 * m * product);
      }
      expected[4 * a] += c.rest.area * std::max(0.0, geometric);
    }
    const double scale = c.force_scale() * std::hypot(bx, by) * 3;
    REQUIRE(largest_difference(dense(c.add(0).block), expected) <= (32 * u + 1e-7) * scale);
    REQUIRE(least_curvature(c.add(0).block, random) >= -32 * u * scale);
  }
}

TEST_CASE("a membrane leaves no net force and no net torque", "[property]") {
  std::mt19937 random(13);
  for (int i = 0; i < 2000; ++i) {
    const Case c = random_case(random, 1e-2);
    D3 force, torque;
    double reach = 0;
    for (int corner = 0; corner < 3; ++corner) {
      const D3 f = wide(c.add(corner).force), arm = wide(c.x[static_cast<std::size_t>(corner)]) - wide(c.x[0]);
      force += f;
      torque += cross(arm, f);
      reach = std::max(reach, length(arm));
    }
    REQUIRE(length(force) <= 72 * u * c.force_scale());
    REQUIRE(length(torque) <= 72 * u * c.force_scale() * reach);
  }
}

TEST_CASE("a rigid motion since the start of the step meets no membrane force, elastic or viscous", "[property]") {
  std::mt19937 random(14);
  for (int i = 0; i < 500; ++i) {
    Case c = random_case(random, 0);
    const RigidMotion motion(random, 0.1);
    for (std::size_t k = 0; k < 3; ++k) c.x[k] = narrow(motion(wide(c.start[k])));
    // Coordinates of up to about 1 m are rounded to u = 2⁻²⁴, which is a strain of 4 u/l over an edge of length l.
    double shortest = INFINITY, size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      shortest = std::min(shortest, length(c.x[k] - c.x[(k + 1) % 3]));
      size = std::max({size, length(c.x[k]), length(c.start[k])});
    }
    REQUIRE(length(c.add(0).force) <= (24 * u + 8 * u * size / shortest) * c.force_scale());
  }
}

TEST_CASE("collapsed triangles give finite membrane forces", "[unit]") {
  std::mt19937 random(15);
  Case c = random_case(random, 1e-3);
  c.x[1] = c.x[0];
  CHECK(std::isfinite(length(c.add(0).force)));
  c.x[2] = c.x[0];
  CHECK(std::isfinite(length(c.add(1).force)));
  CHECK(length(c.add(1).force) == 0);
}
