// Tests the T-shirt of Fig. 14: the paper's counts, a start that touches itself only at the stitched shoulders, and
// grippers that move slowly enough for the bounds.
#include "experiments/scenes/robot_shirt.hpp"

#include <algorithm>
#include <limits>

#include "compare/oracle/smallest_distances.hpp"
#include "experiments/scenes/registry.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/scenes/stitches.hpp"

using namespace ogc::compare;
using namespace ogc::experiments;
using namespace ogc::tests;

namespace {

/// Returns the gap between both jaws of a gripper at time `t` [m]: from the lower jaw's upper side to the upper jaw's
/// lower side.
double opening(const Scene& scene, const PrescribedMotion& motion, double t) {
  const std::vector<Vec3f> jaws = prescribed_targets(scene, motion, t);
  const auto half = static_cast<std::ptrdiff_t>(jaws.size() / 2);
  const auto lower = [](const Vec3f& a, const Vec3f& b) { return a.y < b.y; };
  return static_cast<double>(std::min_element(jaws.begin() + half, jaws.end(), lower)->y) -
         std::max_element(jaws.begin(), jaws.begin() + half, lower)->y;
}

double height(const Scene& scene, double t) { return prescribed_targets(scene, scene.motions[0], t)[0].y; }

}  // namespace

TEST_CASE("robot_shirt has the paper's numbers", "[unit]") {
  const Scene scene = make_scene("robot_shirt", Scale::paper);
  REQUIRE(scene.bodies.size() == 4);
  CHECK(scene.bodies[0].vertex_count == 13842);
  CHECK(scene.bodies[0].triangle_count == 27364);
  CHECK(scene.bodies[1].fixed);
  CHECK(scene.settings.contact_radius == static_cast<double>(2e-3f));
  CHECK(scene.settings.time_step == static_cast<double>(1.0f / 600));
  CHECK(scene.settings.iterations == 10);
  CHECK(scene.settings.steps == 3600);
  for (const Body& body : scene.bodies) {
    CHECK(body.material.contact_stiffness == 100);
    CHECK(body.material.friction == 0.5);
  }
}

TEST_CASE("robot_shirt: a tube with sleeves, whose shoulders are stitched", "[unit]") {
  for (const Scale scale : {Scale::smoke, Scale::small, Scale::paper}) {
    const Scene scene = make_scene("robot_shirt", scale);
    const Body& shirt = scene.bodies[0];
    const Topology topology = build_topology(
        shirt.vertex_count, {scene.mesh.triangles.data(), static_cast<std::size_t>(shirt.triangle_count)});
    CHECK(topology.non_manifold_edges.empty());
    // Topologically the shirt is a sphere with four holes: the hem, both sleeve ends, and the neck. The open shoulders
    // connect the neck to the tops of the sleeves.
    const auto euler = static_cast<int>(shirt.vertex_count) - static_cast<int>(topology.edges.size()) +
                       static_cast<int>(shirt.triangle_count);
    CHECK(euler == 2 - 4);
    CHECK(*std::ranges::max_element(topology.component) == 0);
    CHECK(scene.springs.size() >= 8);
    CHECK(largest_gap(scene) == 0);
    const StitchedStart start = stitched_start(scene);
    CHECK(start.between_partners > 0);
    CHECK(start.others == 0);
    CHECK(scene.rest_positions == scene.mesh.positions);
  }
}

TEST_CASE("robot_shirt: jaws move less than bounds allow in one detection, and close on two layers", "[unit]") {
  for (const Scale scale : {Scale::small, Scale::paper}) {
    const Scene scene = make_scene("robot_shirt", scale);
    const Settings& s = scene.settings;
    CHECK(largest_step(scene) < s.bounds_relaxation * s.detection_radius_cap * s.contact_radius);
    // Open jaws withdraw at 0.47 m/s. At 0.85 r per step, lower jaws would lag behind
    // (experiments/scenes/robot_shirt.hpp).
    CHECK(largest_step(scene) < 0.4 * s.contact_radius);
    for (const PrescribedMotion& motion : scene.motions) {
      CHECK(opening(scene, motion, 0) > 0.03);
      for (const double t : {0.5, 2.4, 5.3})
        CHECK(opening(scene, motion, t) == Approx(2.2 * s.contact_radius).epsilon(1e-4));
      CHECK(opening(scene, motion, 6) > 0.03);
    }
    CHECK(height(scene, 2) - height(scene, 0) == Approx(0.32));
    CHECK(s.detection_fraction == static_cast<double>(0.01f));
    for (const Body& body : scene.bodies) CHECK(body.is_volume() == body.name.ends_with("gripper"));
    CHECK(prescribed_targets(scene, scene.motions[0], 0)[0] ==
          to_single(scene.mesh.positions)[static_cast<std::size_t>(scene.motions[0].vertices[0])]);
  }
}

TEST_CASE("robot_shirt: nothing but stitched shoulders is nearer than the contact radius at the start", "[unit]") {
  // Stitched pairs are moved apart to 1.05 r, the distance between front and back. They then do not determine the
  // smallest distance, and do not hide other pairs.
  Scene scene = make_scene("robot_shirt", Scale::small);
  const double r = scene.settings.contact_radius;
  for (const Spring& s : scene.springs) {
    scene.mesh.positions[static_cast<std::size_t>(s.first)].y += 0.525 * r;
    scene.mesh.positions[static_cast<std::size_t>(s.second)].y -= 0.525 * r;
  }
  const SmallestDistances found = smallest_distances(build_topology(scene), scene.mesh.positions, rigid_groups(scene));
  CHECK(std::min(found.vertex_triangle, found.edge_edge) > r);
}
