// Tests the strip of Fig. 11: the paper's sizes, the rest shape, and a start without intersections.
#include "experiments/scenes/knot.hpp"

#include <algorithm>
#include <cmath>

#include "compare/oracle/audit.hpp"
#include "compare/oracle/smallest_distances.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;
using namespace ogc::experiments;

namespace {

double length(const Vec3& a, const Vec3& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

const Vec3& start(const Scene& scene, Index vertex) { return scene.mesh.positions[static_cast<std::size_t>(vertex)]; }
const Vec3& rest(const Scene& scene, Index vertex) { return scene.rest_positions[static_cast<std::size_t>(vertex)]; }

/// Returns the largest stretch (start length over rest length) between neighbours along the strip.
double largest_stretch(const Scene& scene, const KnotSizes& sizes) {
  double largest = 0;
  for (Index v = 0; v + sizes.columns < sizes.rows * sizes.columns; ++v)
    largest = std::max(largest, length(start(scene, v), start(scene, v + sizes.columns)) /
                                    length(rest(scene, v), rest(scene, v + sizes.columns)));
  return largest;
}

}  // namespace

TEST_CASE("knot has the paper's numbers", "[unit]") {
  const Scene scene = knot();
  REQUIRE(scene.bodies.size() == 1);
  CHECK(scene.bodies[0].vertex_count == 48000);
  CHECK(scene.bodies[0].triangle_count == 91162);
  CHECK(scene.bodies[0].material.lame_mu == 100);
  CHECK(scene.bodies[0].material.bending_stiffness == 2.5e-6);
  CHECK(scene.bodies[0].material.friction == 0.4);
  CHECK(scene.settings.contact_radius == 2e-3);
  CHECK(scene.settings.time_step == 1.0 / 300);
  CHECK(scene.settings.iterations == 50);
  CHECK(scene.settings.steps == 150 + 10500);
  CHECK(scene.gravity == Vec3{});
  CHECK(rest(scene, 47999).x == Approx(9.613));
  CHECK(rest(scene, 47999).z == Approx(0.045));
  // The first and the last control point of the curve are 1.2 m apart along x.
  CHECK(length(start(scene, 0), {-0.9, -0.4, 0.035}) < 1e-6);
  CHECK(length(start(scene, 47980), {0.3, -0.3, 0}) < 1e-6);
}

TEST_CASE(
    "knot: the strip lies straight across its curve, with rows equally far apart on it, stretched at its outer edge "
    "alone",
    "[unit]") {
  const KnotSizes sizes{.rows = 1200, .columns = 10};
  const Scene scene = knot(sizes);
  const double first = length(start(scene, 0), start(scene, sizes.columns));
  for (Index i = 0; i < sizes.rows; ++i) {
    const Index v = i * sizes.columns;
    // Rows are at equal arc lengths, so chords between them are nearly equal.
    if (i > 0) CHECK(length(start(scene, v - sizes.columns), start(scene, v)) == Approx(first).epsilon(0.02));
    for (Index j = 1; j < sizes.columns; ++j)
      CHECK(length(start(scene, v + j - 1), start(scene, v + j)) == Approx(0.005).margin(2e-6));
  }
  CHECK(largest_stretch(scene, sizes) == Approx(6.49).epsilon(0.01));
  CHECK(largest_stretch(knot(), {}) == Approx(7.49).epsilon(0.01));
}

TEST_CASE("knot: the start is free of intersections, its smallest gap as documented", "[unit]") {
  Scene scene = knot();
  round_to_single(scene);
  const Topology topology = build_topology(scene);
  CHECK(audit(topology, scene.mesh.positions).count == 0);
  const SmallestDistances found = smallest_distances(topology, scene.mesh.positions);
  CHECK(std::min(found.vertex_triangle, found.edge_edge) == Approx(0.51e-3).epsilon(0.02));
}

TEST_CASE("knot: end rows rest until the hold is over, then part at 0.2 m/s", "[unit]") {
  const KnotSizes sizes{.rows = 400, .columns = 5, .hold_steps = 150};
  const Scene scene = knot(sizes);
  REQUIRE(scene.motions.size() == 2);
  const auto distance = [&](double t) {
    const Vec3f a = prescribed_targets(scene, scene.motions[0], t)[0],
                b = prescribed_targets(scene, scene.motions[1], t)[0];
    return static_cast<double>(b.x) - a.x;
  };
  CHECK(distance(0.5) == distance(0));
  CHECK(distance(0) == Approx(1.2));
  CHECK(distance(1.5) == Approx(1.4));
  for (const PrescribedMotion& motion : scene.motions) CHECK(motion.vertices.size() == 5);
}
