// Tests the stack of Fig. 10: the paper's sizes, and a start without intersections.
#include "experiments/scenes/fifty_layers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/oracle/smallest_distances.hpp"
#include "experiments/scenes/registry.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;
using namespace ogc::experiments;

namespace {

const Vec3& first_vertex(const Scene& scene, const Body& body) {
  return scene.mesh.positions[static_cast<std::size_t>(body.first_vertex)];
}

const Body& body_named(const Scene& scene, const std::string& name) {
  return *std::ranges::find(scene.bodies, name, &Body::name);
}

}  // namespace

TEST_CASE("fifty_layers has the paper's numbers", "[unit]") {
  const Scene scene = fifty_layers();
  REQUIRE(scene.bodies.size() == 52);
  Index cloth_vertices = 0, cloth_triangles = 0;
  for (std::size_t k = 0; k < 50; ++k) {
    cloth_vertices += scene.bodies[k].vertex_count;
    cloth_triangles += scene.bodies[k].triangle_count;
    CHECK_FALSE(scene.bodies[k].fixed);
  }
  CHECK(cloth_vertices == 245000);
  CHECK(cloth_triangles == 476100);
  CHECK(body_named(scene, "cylinder").vertex_count == 1224);
  CHECK(body_named(scene, "cylinder").fixed);
  CHECK(body_named(scene, "ground").fixed);
  CHECK(body_named(scene, "ground").material.friction == 0.3);
  CHECK(scene.bodies[0].material.friction == 0.2);
  CHECK(scene.bodies[0].material.contact_stiffness == 100);
  CHECK(scene.bodies[0].material.bending_stiffness == 5e-7);
  CHECK(scene.settings.contact_radius == 3e-3);
  CHECK(scene.settings.time_step == 1.0 / 1200);
  CHECK(scene.settings.iterations == 40);
  CHECK(scene.settings.steps == 4800);
  const FiftyLayersSizes finer = fifty_layers_1m_sizes();
  CHECK(finer.layers * finer.vertices_a_side * finer.vertices_a_side == 994050);
  CHECK(finer.layers * 2 * (finer.vertices_a_side - 1) * (finer.vertices_a_side - 1) == 1960000);
  CHECK(finer.contact_radius == 2e-3);
}

TEST_CASE("fifty_layers: layers lie 1.05 r apart from 0.30 m on, each shifted by itself, the same ones for a seed",
          "[unit]") {
  const FiftyLayersSizes sizes{.layers = 50, .vertices_a_side = 3, .cylinder = {6, 3, 1}};
  const Scene scene = fifty_layers(sizes);
  CHECK(fifty_layers(sizes).mesh.positions == scene.mesh.positions);
  double sum = 0, squares = 0;
  for (std::size_t k = 0; k < 50; ++k) {
    const Vec3& corner = first_vertex(scene, scene.bodies[k]);
    CHECK(corner.y == Approx(0.30 + 1.05 * 3e-3 * static_cast<double>(k)));
    for (const double shift : {corner.x + 0.5, corner.z + 0.5}) {
      sum += shift;
      squares += shift * shift;
      CHECK(std::abs(shift) < 6 * 3e-3);
    }
  }
  // For 100 draws, the mean must be within three of its standard errors, and the standard deviation within about three
  // of its standard errors.
  CHECK(std::abs(sum / 100) < 3 * 3e-3 / 10);
  CHECK(std::sqrt(squares / 100) == Approx(3e-3).epsilon(0.22));
  FiftyLayersSizes other = sizes;
  other.seed = 1;
  CHECK(fifty_layers(other).mesh.positions != scene.mesh.positions);
}

TEST_CASE("fifty_layers: at the start nothing is nearer than the layers to each other, 1.05 r", "[unit]") {
  const double r = 0.015;
  Scene scene = fifty_layers({.layers = 4, .vertices_a_side = 14, .contact_radius = r, .cylinder = {24, 9, 3}});
  round_to_single(scene);
  const SmallestDistances found = smallest_distances(build_topology(scene), scene.mesh.positions, rigid_groups(scene));
  CHECK(std::min(found.vertex_triangle, found.edge_edge) == Approx(1.05 * r).epsilon(1e-5));
}

TEST_CASE("two_hundred_layers: four times the layers of fifty_layers, as far apart, at every scale", "[unit]") {
  const FiftyLayersSizes sizes = two_hundred_layers_sizes(), fifty;
  CHECK(sizes.layers == 200);
  CHECK(sizes.layers * sizes.vertices_a_side * sizes.vertices_a_side == 980000);
  CHECK(sizes.vertices_a_side == fifty.vertices_a_side);
  CHECK(sizes.contact_radius == fifty.contact_radius);
  for (const Scale scale : {Scale::smoke, Scale::small}) {
    const Scene scene = make_scene("two_hundred_layers", scale);
    const auto layers = std::ranges::count_if(scene.bodies, [](const Body& body) { return !body.fixed; });
    CHECK(layers == (scale == Scale::smoke ? 12 : 40));
    const SmallestDistances found = smallest_distances(build_topology(scene), scene.mesh.positions,
                                                       rigid_groups(scene));
    CHECK(std::min(found.vertex_triangle, found.edge_edge) ==
          Approx(1.05 * scene.settings.contact_radius).epsilon(1e-5));
  }
}
