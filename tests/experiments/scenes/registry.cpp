// Tests every registered scene at every scale. It must be valid, in single precision, and have the paper's ratio of
// contact radius and edge length.
#include "experiments/scenes/registry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "compare/oracle/audit.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/validate.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;
using namespace ogc::experiments;

namespace {

double length(const Vec3& a, const Vec3& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

// Returns the shortest edge of the first body, the cloth, at rest.
double shortest_edge(const Scene& scene) {
  double result = std::numeric_limits<double>::infinity();
  for (Index t = 0; t < scene.bodies[0].triangle_count; ++t) {
    const auto& [a, b, c] = scene.mesh.triangles[static_cast<std::size_t>(t)];
    const Vec3 &p = scene.rest_positions[static_cast<std::size_t>(a)],
               &q = scene.rest_positions[static_cast<std::size_t>(b)];
    const Vec3& s = scene.rest_positions[static_cast<std::size_t>(c)];
    result = std::min({result, length(p, q), length(q, s), length(s, p)});
  }
  if (scene.bodies[0].triangle_count > 0) return result;
  for (const Edge& e : scene.mesh.loose_edges)
    result = std::min(result, length(scene.rest_positions[static_cast<std::size_t>(e[0])],
                                     scene.rest_positions[static_cast<std::size_t>(e[1])]));
  return result;
}

Vec3f at_vertex(const Scene& scene, const PrescribedMotion& motion, std::size_t i, double t) {
  return prescribed_targets(scene, motion, t)[i];
}

}  // namespace

TEST_CASE("every scene is valid at every scale, named as registered, and already in single precision", "[unit]") {
  std::string_view previous;
  for (const SceneInfo& info : scenes()) {
    CHECK(previous < info.name);
    previous = info.name;
    for (const Scale scale : {Scale::smoke, Scale::small, Scale::paper}) {
      INFO(info.name << " at scale " << static_cast<int>(scale));
      const Scene scene = make_scene(info.name, scale);
      CHECK(describe(validate(scene)).empty());
      CHECK(scene.name == info.name);
      Scene rounded = scene;
      round_to_single(rounded);
      CHECK(rounded == scene);
    }
  }
}

// Larger scenes take seconds each. They are audited when `ogc run` starts them.
TEST_CASE("no scene starts with an intersection but between stitched primitives", "[unit]") {
  constexpr std::size_t largest = 100'000;
  for (const SceneInfo& info : scenes()) {
    for (const Scale scale : {Scale::smoke, Scale::small, Scale::paper}) {
      INFO(info.name << " at scale " << static_cast<int>(scale));
      const Scene scene = make_scene(info.name, scale);
      if (scale == Scale::paper && scene.mesh.positions.size() > largest) continue;
      CHECK(audit(build_topology(scene), scene.mesh.positions, exclusions(scene)).count == 0);
    }
  }
}

TEST_CASE("scales shrink vertices and steps, and keep the radius in units of the spacing", "[unit]") {
  for (const SceneInfo& info : scenes()) {
    INFO(info.name);
    const Scene smoke = make_scene(info.name, Scale::smoke), small = make_scene(info.name, Scale::small),
                paper = make_scene(info.name, Scale::paper);
    CHECK(smoke.mesh.positions.size() < small.mesh.positions.size());
    CHECK(small.mesh.positions.size() < paper.mesh.positions.size());
    CHECK(smoke.settings.steps < small.settings.steps);
    CHECK(small.settings.steps <= paper.settings.steps);
    const double regime = paper.settings.contact_radius / shortest_edge(paper);
    for (const Scene& scene : {smoke, small}) {
      // Error of the ratio: single precision rounds each position of up to 0.5 m by at most 2⁻²⁵ m. (Layers are
      // slightly larger, strips are smaller.) The two compared ratios use one edge each, so four positions are rounded.
      // Edges are longer than 7 mm (2 mm across a strip of 4.5 cm; 1 mm for yarn).
      const double edge = scene.mesh.triangles.empty() ? 0.001 : 0.007;
      CHECK(scene.settings.contact_radius / shortest_edge(scene) == Approx(regime).epsilon(4 * 0x1p-25 / edge));
    }
  }
}

TEST_CASE("yarn scenes have the paper's numbers: one rod, neighbours of a smooth yarn are no contact", "[unit]") {
  for (const char* name : {"yarn_stretch", "yarn_twist"}) {
    const Scene scene = make_scene(name, Scale::paper);
    CHECK(scene.mesh.positions.size() == 65'266);
    CHECK(scene.mesh.loose_edges.size() == 65'265);
    CHECK(scene.settings.contact_radius == static_cast<double>(3e-3f));
    CHECK(scene.settings.time_step == static_cast<double>(4e-4f));
    CHECK(scene.settings.iterations == 4);
    REQUIRE(scene.bodies[0].material.rod);
    CHECK(scene.bodies[0].material.rod->density == static_cast<double>(1e-3f));
    REQUIRE(scene.motions.size() == 2);
    // Each motion holds the vertices within 10 mm of an edge of the knit, including the open loops of the last row.
    CHECK(scene.motions[0].vertices.size() > 33 * 12);
  }
  CHECK(make_scene("yarn_stretch", Scale::paper).settings.steps == 16'250);
}

TEST_CASE("cloth_on_sphere has the paper's numbers", "[unit]") {
  const Scene scene = make_scene("cloth_on_sphere", Scale::paper);
  REQUIRE(scene.bodies.size() == 2);
  CHECK(scene.bodies[0].vertex_count == 4900);
  CHECK(scene.bodies[0].triangle_count == 9522);
  CHECK(scene.bodies[1].vertex_count == 642);
  CHECK(scene.bodies[1].fixed);
  CHECK_FALSE(scene.bodies[0].fixed);
  CHECK(scene.bodies[0].material.contact_stiffness == 10);
  CHECK(scene.bodies[0].material.friction == 0.5);
  CHECK(scene.bodies[0].material.membrane_damping == static_cast<double>(2e-6f));
  CHECK(scene.settings.contact_radius == static_cast<double>(5e-3f));
  CHECK(scene.settings.time_step == static_cast<double>(0.01f));
  CHECK(scene.settings.iterations == 40);
  CHECK(scene.settings.steps == 100);
  CHECK(scene.motions.empty());
  for (const Index v : {0, 4899})
    CHECK(scene.mesh.positions[static_cast<std::size_t>(v)].y == static_cast<double>(0.30f));
}

TEST_CASE("twist has the paper's numbers", "[unit]") {
  const Scene scene = make_scene("twist", Scale::paper);
  REQUIRE(scene.bodies.size() == 1);
  CHECK(scene.bodies[0].vertex_count == 10000);
  CHECK(scene.bodies[0].triangle_count == 19602);
  CHECK(scene.bodies[0].material.contact_stiffness == 100);
  CHECK(scene.bodies[0].material.friction == static_cast<double>(0.2f));
  CHECK(scene.bodies[0].material.bending_stiffness == static_cast<double>(1e-6f));
  CHECK(scene.settings.contact_radius == static_cast<double>(2e-3f));
  CHECK(scene.settings.time_step == static_cast<double>(1.0f / 300));
  CHECK(scene.settings.iterations == 10);
  CHECK(scene.settings.steps == 9600);
  CHECK(scene.gravity == Vec3{});
}

TEST_CASE("twist turns its two end columns against each other, a relative turn in four seconds", "[unit]") {
  const Scene scene = make_scene("twist", Scale::paper);
  REQUIRE(scene.motions.size() == 2);
  for (const PrescribedMotion& motion : scene.motions) {
    CHECK(motion.vertices.size() == 100);
    for (const Index v : motion.vertices) CHECK(std::abs(scene.mesh.positions[static_cast<std::size_t>(v)].x) == 0.5);
  }
  // After 2 s both columns have rotated by 90° in opposite directions. A vertex at z = −0.5 has moved to y = 0.5 in one
  // column and to y = −0.5 in the other.
  const Vec3f left = at_vertex(scene, scene.motions[0], 0, 2), right = at_vertex(scene, scene.motions[1], 0, 2);
  CHECK(left.y == Approx(0.5));
  CHECK(right.y == Approx(-0.5));
  CHECK(left.x == -0.5f);
  // After 4 s both have rotated by 180°, in opposite directions, to the same position.
  CHECK(at_vertex(scene, scene.motions[0], 0, 4).z == Approx(0.5));
  CHECK(at_vertex(scene, scene.motions[1], 0, 4).z == Approx(0.5));
}

TEST_CASE("mat_twist has the size of Fig. 19, and all of its vertices are on the surface", "[unit]") {
  const Scene scene = make_scene("mat_twist", Scale::paper);
  REQUIRE(scene.bodies.size() == 1);
  CHECK(scene.mesh.positions.size() == 15312);
  CHECK(scene.mesh.tetrahedra.size() == 44892);
  CHECK(scene.mesh.triangles.size() == 30620);
  const Topology topology = build_topology(scene);
  for (Index v = 0; v < topology.vertex_count; ++v) CHECK(topology.on_surface(v));
  CHECK(scene.bodies[0].material.solid_mu == Approx(7142.857));
  CHECK(scene.bodies[0].material.solid_lambda == Approx(28571.43));
  CHECK(scene.settings.contact_radius == static_cast<double>(2e-3f));
  CHECK(scene.settings.steps == 3840);
  REQUIRE(scene.motions.size() == 2);
  for (const PrescribedMotion& motion : scene.motions) {
    CHECK(motion.vertices.size() == 174);
    for (const Index v : motion.vertices) CHECK(std::abs(scene.mesh.positions[static_cast<std::size_t>(v)].x) == 0.5);
  }
  CHECK(scene.motions[0].angular_velocity == -scene.motions[1].angular_velocity);
  // After 1 s the ends have rotated by 90° in opposite directions.
  CHECK(at_vertex(scene, scene.motions[0], 0, 1).y == Approx(0.5).epsilon(1e-6));
  CHECK(at_vertex(scene, scene.motions[1], 0, 1).y == Approx(-0.5).epsilon(1e-6));
}

TEST_CASE("large_radius_twist has the paper's numbers, and a radius of one edge at every scale", "[unit]") {
  const Scene scene = make_scene("large_radius_twist", Scale::paper);
  CHECK(scene.bodies[0].vertex_count == 40000);
  CHECK(scene.bodies[0].triangle_count == 79202);
  CHECK(scene.settings.contact_radius == static_cast<double>(5e-3f));
  CHECK(get_setting(scene.settings, "ipc_distance") == scene.settings.contact_radius);
  // The handles rotate by 90° each, in opposite directions.
  const double end = scene.settings.time_step * static_cast<double>(scene.settings.steps);
  CHECK(std::abs(scene.motions[0].angular_velocity - scene.motions[1].angular_velocity) * end ==
        Approx(std::numbers::pi));
  for (const Scale scale : {Scale::smoke, Scale::small}) {
    const Scene smaller = make_scene("large_radius_twist", scale);
    CHECK(get_setting(smaller.settings, "ipc_distance") / shortest_edge(smaller) == Approx(0.995).epsilon(1e-4));
  }
}

TEST_CASE("one_iteration_drop has the paper's numbers, and one iteration for every solver", "[unit]") {
  const Scene scene = make_scene("one_iteration_drop", Scale::paper);
  CHECK(scene.bodies[0].vertex_count == 4900);
  CHECK(scene.settings.time_step == static_cast<double>(1.0f / 500));
  CHECK(scene.settings.steps == 800);
  CHECK(scene.settings.iterations == 1);
  CHECK(get_setting(scene.settings, "ipc_iterations") == 1);
  CHECK(get_setting(scene.settings, "newton_iterations") == 1);
  CHECK(get_setting(scene.settings, "ipc_velocity_tolerance") == 0);
  const Vec3& top = scene.mesh.positions[static_cast<std::size_t>(scene.bodies[1].first_vertex)];
  CHECK(length(top, {-0.15, 0, 0}) == Approx(0.10).epsilon(1e-6));
}

TEST_CASE("unknown scenes and scales are refused with the nearest name", "[unit]") {
  CHECK_THROWS_AS(make_scene("twits", Scale::smoke), InputError);
  CHECK_THROWS_WITH(make_scene("twits", Scale::smoke),
                    ContainsSubstring("did you mean 'twist'?") && ContainsSubstring("cloth_on_sphere"));
  CHECK_THROWS_WITH(parse_scale("smal"), ContainsSubstring("did you mean 'small'?"));
  CHECK(parse_scale("smoke") == Scale::smoke);
  CHECK(parse_scale("small") == Scale::small);
  CHECK(parse_scale("paper") == Scale::paper);
}

TEST_CASE("a scene without a data set refuses one", "[unit]") {
  CHECK_THROWS_WITH(make_scene("twist", Scale::smoke, "somewhere"),
                    ContainsSubstring("twist") && ContainsSubstring("somewhere"));
}
