// Tests rest data by sums and identities that hold for every mesh, and by shapes whose rest data are known in closed
// form.
#include "reference/solvers/kinds/rest_state.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "tests/catch.hpp"
#include "tests/compare/problem/small_scene.hpp"
#include "tests/reference/meshes.hpp"

using namespace ogc;
using compare::RestStateTruth;
using compare::Scene;
using compare::Vec3;

namespace {

RestStateTruth rest_of(Scene& scene) {
  round_to_single(scene);
  const compare::Topology topology = compare::build_topology(scene);
  return reference::rest_state({&scene, &topology});
}

/// Returns a crumpled sheet of one free body.
Scene crumpled(unsigned seed) {
  std::mt19937 random(seed);
  const tests::Surface surface = tests::jittered(tests::grid(6), random, 0.4f);
  compare::Mesh mesh{compare::to_double(surface.positions), surface.triangles, {}};
  Scene scene;
  scene.name = "crumpled";
  append_body(scene, {.name = "sheet", .material = {}}, mesh);
  return scene;
}

/// Returns two triangles on the edge from (0, 0, 0) to (2, 0, 0): one corner at (1, 1, 0), the other at `far`.
Scene hinge(const Vec3& far) {
  Scene scene;
  scene.name = "hinge";
  append_body(scene, {.name = "sheet", .material = {}},
              {{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, far}, {{0, 1, 2}, {1, 0, 3}}, {}});
  return scene;
}

double angle_of(const Vec3& far) {
  Scene scene = hinge(far);
  return rest_of(scene).rest_angle.at(0);
}

double distance(const Vec3& a, const Vec3& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

/// Returns the area from the three sides.
double area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double p = distance(a, b), q = distance(b, c), r = distance(c, a), s = (p + q + r) / 2;
  return std::sqrt(s * (s - p) * (s - q) * (s - r));
}

}  // namespace

TEST_CASE("rest state: masses add up to density times area, and areas are those of the three sides", "[property]") {
  Scene scene = crumpled(3);
  scene.bodies[0].material.density = 0.25;
  const RestStateTruth rest = rest_of(scene);
  double mass = 0, whole = 0;
  for (const double m : rest.mass) mass += m;
  REQUIRE(rest.area.size() == scene.mesh.triangles.size());
  for (std::size_t t = 0; t < rest.area.size(); ++t) {
    const auto& [a, b, c] = scene.mesh.triangles[t];
    const auto& x = scene.rest_positions;
    CHECK(rest.area[t] == Approx(area(x[std::size_t(a)], x[std::size_t(b)], x[std::size_t(c)])).epsilon(1e-9));
    whole += rest.area[t];
  }
  CHECK(mass == Approx(0.25 * whole).epsilon(1e-14));
}

TEST_CASE(
    "rest state: gradients turn the rest triangle into its plane, first edge along the first axis, third corner above "
    "it",
    "[property]") {
  Scene scene = crumpled(5);
  const RestStateTruth rest = rest_of(scene);
  for (std::size_t t = 0; t < rest.gradient.size(); ++t) {
    const auto& corners = rest.exact.triangles[t].corner;
    const auto at = [&](std::size_t k) { return scene.rest_positions[static_cast<std::size_t>(corners[k])]; };
    const auto& g = rest.gradient[t];
    // F = (x₁ − x₀) ∇N₁ᵀ + (x₂ − x₀) ∇N₂ᵀ, because ∇N₀ = −∇N₁ − ∇N₂.
    const auto column = [&](std::size_t axis) {
      const Vec3 o = at(0), p = at(1), q = at(2);
      const double a = g[0][axis], b = g[1][axis];
      return Vec3{a * (p.x - o.x) + b * (q.x - o.x), a * (p.y - o.y) + b * (q.y - o.y),
                  a * (p.z - o.z) + b * (q.z - o.z)};
    };
    const auto product = [](const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    const Vec3 first = column(0), second = column(1);
    CHECK(product(first, first) == Approx(1).epsilon(1e-12));
    CHECK(product(second, second) == Approx(1).epsilon(1e-12));
    CHECK(std::abs(product(first, second)) < 1e-12);
    const Vec3 o = at(0), p = at(1), q = at(2);
    CHECK(product(first, {p.x - o.x, p.y - o.y, p.z - o.z}) == Approx(distance(o, p)).epsilon(1e-12));
    CHECK(product(second, {q.x - o.x, q.y - o.y, q.z - o.z}) > 0);
    CHECK(g[1][0] == 0);
  }
}

TEST_CASE("rest state: a flat hinge has angle 0, a right angle has a quarter turn, folded ones half a turn", "[unit]") {
  using std::numbers::pi;
  CHECK(angle_of({1, -1, 0}) == 0);
  // For the far corner (1, 0, 1) the second normal is (0, 1, 0)·2: +z rotated about +x by −90°.
  CHECK(angle_of({1, 0, 1}) == Approx(-pi / 2).epsilon(1e-15));
  CHECK(angle_of({1, 0, -1}) == Approx(pi / 2).epsilon(1e-15));
  CHECK(angle_of({1, -1, 1}) == Approx(-pi / 4).epsilon(1e-15));
  CHECK(std::abs(angle_of({1, 1, 0})) == Approx(pi).epsilon(1e-15));
  CHECK(angle_of({0.5, -1e-3, 1}) + angle_of({0.5, -1e-3, -1}) == 0);
}

TEST_CASE("rest state: the angle is the one by which the second triangle was turned, however far", "[property]") {
  for (int k = -62; k <= 62; ++k) {
    const double angle = 0.05 * k;
    CHECK(angle_of({0.7, -3 * std::cos(angle), 3 * std::sin(angle)}) == Approx(-angle).margin(1e-6));
  }
}

TEST_CASE("rest state: hinges are as stiff as 3 k e^2 / (A0 + A1)", "[unit]") {
  Scene scene = hinge({1, -2, 0});
  scene.bodies[0].material.bending_stiffness = 0.5;
  const RestStateTruth rest = rest_of(scene);
  // The edge has length 2, the areas are 1 and 2.
  CHECK(rest.stiffness.at(0) == 0.5 * 3 * 4 / 3);
  CHECK(rest.exact.hinges[0].vertex == std::array<compare::Index, 4>{0, 1, 2, 3});
  CHECK(rest.edge_length_squared == std::vector<double>{4, 2, 5, 2, 5});
  CHECK(rest.mass[2] == Approx(scene.bodies[0].material.density / 3).epsilon(1e-15));
}

TEST_CASE("rest state: needles and folds keep every bit", "[unit]") {
  // A needle has a height of 2⁻¹⁹ over a side of 2²⁰, so 2A = 2. The angle of a fold differs from π by 2⁻¹⁹.
  Scene scene;
  scene.name = "needle";
  append_body(scene, {.name = "sheet", .material = {}},
              {{{0, 0, 0}, {0x1p20, 0, 0}, {0x1p19, 0x1p-19, 0}}, {{0, 1, 2}}, {}});
  CHECK(rest_of(scene).area[0] == 1);
  CHECK(rest_of(scene).gradient[0][1][1] == 0x1p19);
  CHECK(std::numbers::pi - std::abs(angle_of({1, 1, 0x1p-19})) == Approx(0x1p-19).epsilon(1e-9));
}

TEST_CASE(
    "rest state: bodies meet with the harmonic mean of stiffness, 0 where one has none, and the arithmetic mean of "
    "friction",
    "[unit]") {
  Scene scene = tests::small_scene();
  scene.bodies[0].material.contact_stiffness = 10;
  scene.bodies[0].material.friction = 0.5;
  scene.bodies[1].material.contact_stiffness = 40;
  scene.bodies[1].material.friction = 0;
  RestStateTruth rest = rest_of(scene);
  CHECK(rest.meeting_stiffness == std::vector<double>{10, 16, 16, 40});
  CHECK(rest.meeting_friction == std::vector<double>{0.5, 0.25, 0.25, 0});
  scene.bodies[1].material.contact_stiffness = 0;
  rest = rest_of(scene);
  CHECK(rest.meeting_stiffness == std::vector<double>{10, 0, 0, 0});
}

TEST_CASE("rest state: fixed bodies weigh nothing, and they and models of kind none have no stencils", "[unit]") {
  Scene scene = tests::small_scene();
  RestStateTruth rest = rest_of(scene);
  CHECK(rest.exact.triangles.size() == 2);
  CHECK(rest.exact.hinges.size() == 1);
  CHECK(rest.mass[4] == 0);
  scene.bodies[0].material.membrane = compare::MembraneModel::none;
  scene.bodies[0].material.bending = compare::BendingModel::none;
  const double mass = rest.mass[0];
  rest = rest_of(scene);
  CHECK(rest.exact.triangles.empty());
  CHECK(rest.exact.hinges.empty());
  CHECK(rest.mass[0] == mass);
  CHECK(rest.exact.edge_length_squared.size() == 8);
}

TEST_CASE("rest state: units of errors follow Euler's rule for what scales with the shape", "[property]") {
  // A scale is Σ ‖∂f/∂q‖ ‖q‖ over the inputs q of a result f. If f is homogeneous of degree n, then Σ ∂f/∂q · q = n f,
  // so the scale is at least n |f|.
  Scene scene = crumpled(7);
  const RestStateTruth rest = rest_of(scene);
  for (std::size_t t = 0; t < rest.area.size(); ++t) {
    CHECK(rest.area_scale[t] >= 2 * rest.area[t] * (1 - 1e-12));
    for (std::size_t k = 0; k < 2; ++k)
      CHECK(rest.gradient_scale[t][k] >= std::hypot(rest.gradient[t][k][0], rest.gradient[t][k][1]) * (1 - 1e-12));
  }
  for (std::size_t e = 0; e < rest.edge_length_squared.size(); ++e)
    CHECK(rest.edge_length_squared_scale[e] == Approx(2 * rest.edge_length_squared[e]));
  for (std::size_t i = 0; i < rest.stiffness.size(); ++i) {
    CHECK(rest.stiffness_scale[i] >= rest.stiffness[i]);
    CHECK(rest.rest_angle_scale[i] >= 2);
  }
  for (std::size_t v = 0; v < rest.mass.size(); ++v) CHECK(rest.mass_scale[v] >= 3 * rest.mass[v] * (1 - 1e-12));
}
