#include "fast/stages/rest_state.hpp"

#include <cmath>
#include <cstring>
#include <numeric>

#include "compare/problem/error.hpp"
#include "fast/kernels/rest_state.hpp"
#include "tests/catch.hpp"
#include "tests/fast/scenes.hpp"

using namespace ogc;
using namespace ogc::fast;

TEST_CASE("lumped mass is density times area, a third of each triangle's to its corners", "[unit]") {
  compare::Scene scene = test::empty_scene();
  test::add_sheet(scene, 5, 0.5, 0.1, false).material.density = 0.2;
  test::add_sheet(scene, 3, 1, 0, true);
  const RestState rest = build_rest_state(scene, compare::build_topology(scene));
  CHECK(std::accumulate(rest.mass.begin(), rest.mass.end(), 0.0) == Approx(0.2 * 0.25));
  CHECK(rest.mass[1] == Approx(0.2 * (0.125 * 0.125 / 2) / 3 * 2));  // a border vertex with two triangles
  CHECK(rest.mass[25] == 0);
  CHECK(rest.mobility[24] == Mobility::free);
  CHECK(rest.mobility[25] == Mobility::fixed);
  CHECK(rest.triangles.size() == 32);
}

TEST_CASE("shape gradients reproduce the rest triangle: they sum to zero and F is orthonormal at rest", "[property]") {
  const compare::Vec3 p[3] = {{0.1, 0.2, 0.3}, {0.4, 0.1, 0.35}, {0.2, 0.5, 0.1}};
  const RestTriangle rest = rest_triangle(p[0], p[1], p[2]);
  double f[3][2] = {};
  for (int k = 0; k < 3; ++k) {
    for (int a = 0; a < 2; ++a) {
      f[0][a] += p[k].x * rest.gradient[k][a];
      f[1][a] += p[k].y * rest.gradient[k][a];
      f[2][a] += p[k].z * rest.gradient[k][a];
    }
  }
  const auto product = [&](int a, int b) { return f[0][a] * f[0][b] + f[1][a] * f[1][b] + f[2][a] * f[2][b]; };
  CHECK(product(0, 0) == Approx(1));
  CHECK(product(1, 1) == Approx(1));
  CHECK(product(0, 1) == Approx(0).margin(1e-12));
  CHECK(rest.gradient[0][0] + rest.gradient[1][0] + rest.gradient[2][0] == Approx(0).margin(1e-12));
}

TEST_CASE("only manifold interior edges of moving bodies become hinges, with 3 e^2 / (A0 + A1)", "[unit]") {
  compare::Scene scene = test::empty_scene();
  test::add_sheet(scene, 2, 1, 0.1, false).material.bending_stiffness = 1e-6;
  test::add_sheet(scene, 4, 1, 0, true);
  const RestState rest = build_rest_state(scene, compare::build_topology(scene));
  REQUIRE(rest.hinges.size() == 1);
  CHECK(rest.hinges[0].stiffness == Approx(1e-6 * 3 * 2 / 1.0));  // the diagonal of the unit square; both areas are 1/2
  CHECK(rest.hinges[0].angle == 0);
}

TEST_CASE("bodies meet with the harmonic mean of stiffness and the arithmetic mean of friction", "[unit]") {
  compare::Scene scene = test::empty_scene();
  compare::Material soft, hard;
  soft.contact_stiffness = 10, soft.friction = 0.5;
  hard.contact_stiffness = 40, hard.friction = 0.1;
  test::add_sheet(scene, 2, 1, 0.1, false, soft);
  test::add_sheet(scene, 2, 1, 0, true, hard);
  const RestState rest = build_rest_state(scene, compare::build_topology(scene));
  REQUIRE(rest.contact.size() == 4);
  CHECK(rest.contact[0].stiffness == 10);
  CHECK(rest.contact[1].stiffness == Approx(16));
  CHECK(rest.contact[2].stiffness == rest.contact[1].stiffness);
  CHECK(rest.contact[1].friction == Approx(0.3));
  for (const double other : {0.0, 40.0}) {  // a body without stiffness repels nothing
    scene.bodies[0].material.contact_stiffness = 0, scene.bodies[1].material.contact_stiffness = other;
    for (const int pair : {0, 1, 2}) {
      const RestState none = build_rest_state(scene, compare::build_topology(scene));
      CHECK(none.contact[static_cast<std::size_t>(pair)].stiffness == 0);
    }
  }
}

TEST_CASE("models of kind none leave no stencils, and a moving vertex without mass is refused by name", "[unit]") {
  compare::Scene scene = test::empty_scene();
  compare::Material bare;
  bare.membrane = compare::MembraneModel::none;
  bare.bending = compare::BendingModel::none;
  test::add_sheet(scene, 3, 1, 0, false, bare);
  const RestState rest = build_rest_state(scene, compare::build_topology(scene));
  CHECK(rest.triangles.empty());
  CHECK(rest.hinges.empty());
  scene.bodies[0].material.density = 0;
  CHECK_THROWS_AS(build_rest_state(scene, compare::build_topology(scene)), compare::InputError);
}

TEST_CASE("a rest state put into an answer and taken out again is the same, bit for bit", "[property]") {
  compare::Scene scene = test::empty_scene();
  compare::Material soft;
  soft.contact_stiffness = 10, soft.membrane_damping = 0.1, soft.bending_damping = 0.2;
  test::add_sheet(scene, 5, 0.7, 0.1, false, soft);
  test::add_sheet(scene, 3, 1, 0, true);
  scene.motions.push_back({.name = "held", .vertices = {0, 3}, .keyframes = {}});
  const compare::Topology topology = compare::build_topology(scene);
  const RestState rest = build_rest_state(scene, topology),
                  again = rest_state_of({&scene, &topology}, rest_state_out({&scene, &topology}));
  const auto same = [](const auto& a, const auto& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
  };
  CHECK(same(rest.mass, again.mass));
  CHECK(same(rest.mobility, again.mobility));
  CHECK(same(rest.body, again.body));
  CHECK(same(rest.triangles, again.triangles));
  CHECK(same(rest.hinges, again.hinges));
  CHECK(same(rest.edge_length_squared, again.edge_length_squared));
  CHECK(same(rest.materials, again.materials));
  CHECK(same(rest.contact, again.contact));
  CHECK(rest.mobility[3] == Mobility::prescribed);
  for (const TriangleRest& t : rest.triangles) {
    for (int axis = 0; axis < 2; ++axis) CHECK(t.gradient[0][axis] == -(t.gradient[1][axis] + t.gradient[2][axis]));
  }
}
