// Numbers are the paper's Table 1 and the authors' published parameters. The ground is a mesh, so that contact, bounds
// and audit need no special code.
#include "experiments/scenes/fifty_layers.hpp"

#include "compare/judge/cases/random.hpp"
#include "experiments/scenes/materials.hpp"

namespace ogc::experiments {
namespace {

compare::Material ground_material() {
  compare::Material material = layer_cloth();
  material.friction = 0.3;
  return material;
}

/// Returns the sum of 12 uniform numbers minus 6: mean 0, standard deviation 1, absolute value at most 6.
double normal_deviate(compare::Random& random) {
  double sum = -6;
  for (int k = 0; k < 12; ++k) sum += random.unit();
  return sum;
}

compare::Mesh layer(const FiftyLayersSizes& sizes, compare::Index number) {
  compare::Mesh mesh = grid(sizes.vertices_a_side, 1, 0.30 + 1.05 * sizes.contact_radius * number);
  compare::Random random("fifty_layers", "shift", sizes.seed, static_cast<std::uint64_t>(number));
  const double x = sizes.shift * normal_deviate(random), z = sizes.shift * normal_deviate(random);
  for (compare::Vec3& v : mesh.positions) v = {v.x + x, v.y, v.z + z};
  return mesh;
}

}  // namespace

compare::Scene fifty_layers(const FiftyLayersSizes& sizes) {
  compare::Scene scene;
  scene.name = sizes.name;
  for (compare::Index k = 0; k < sizes.layers; ++k)
    append_body(scene, {.name = "layer_" + std::to_string(k + 1), .material = layer_cloth()}, layer(sizes, k));
  append_body(scene, {.name = "cylinder", .fixed = true, .material = layer_cloth()},
              cylinder(sizes.cylinder, 0.25, 0.5, {-0.18, 0, 0}));
  append_body(scene, {.name = "ground", .fixed = true, .material = ground_material()},
              ground(sizes.vertices_a_side, -0.60));
  scene.settings.time_step = 1.0 / 1200;
  scene.settings.steps = sizes.steps;
  scene.settings.iterations = 40;
  scene.settings.contact_radius = sizes.contact_radius;
  scene.settings.seed = static_cast<std::int64_t>(sizes.seed);
  return scene;
}

FiftyLayersSizes fifty_layers_1m_sizes() {
  return {.name = "fifty_layers_1m", .vertices_a_side = 141, .contact_radius = 2e-3};
}

FiftyLayersSizes two_hundred_layers_sizes() { return {.name = "two_hundred_layers", .layers = 200, .steps = 7200}; }

}  // namespace ogc::experiments
