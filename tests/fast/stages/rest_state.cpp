#include "fast/stages/rest_state.hpp"

#include <cstring>

#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/fast/scenes.hpp"

using namespace ogc;
using namespace ogc::fast;

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
