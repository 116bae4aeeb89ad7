// Numbers are the paper's Table 1 and the authors' published parameters. The damping of the authors' layers is our
// choice.
#include "experiments/scenes/cloth_on_sphere.hpp"

#include "compare/problem/readers.hpp"
#include "experiments/scenes/materials.hpp"
#include "experiments/scenes/shapes.hpp"

namespace ogc::experiments {

compare::Material sphere_scene_material() {
  compare::Material material = layer_cloth();
  material.contact_stiffness = 10;
  material.friction = 0.5;
  return material;
}

void append_sphere(compare::Scene& scene, int subdivisions, double radius) {
  append_body(scene, {.name = "sphere", .fixed = true, .material = sphere_scene_material()},
              icosphere(subdivisions, radius, {-0.15, 0, 0}));
}

compare::Scene cloth_on_sphere(const ClothOnSphereSizes& sizes) {
  compare::Scene scene;
  scene.name = "cloth_on_sphere";
  append_body(scene, {.name = "cloth", .material = sphere_scene_material()}, grid(sizes.vertices_a_side, 1, 0.30));
  append_sphere(scene, sizes.sphere_subdivisions, sizes.sphere_radius);
  scene.settings.time_step = 1.0 / 100;
  scene.settings.steps = sizes.steps;
  scene.settings.iterations = 40;
  scene.settings.contact_radius = 5e-3 * 69 / (sizes.vertices_a_side - 1);
  set_declared(scene.settings, "ipc_distance", scene.settings.contact_radius / 5);
  set_declared(scene.settings, "ipc_stopping", "velocity");
  set_declared(scene.settings, "ipc_ccd", "full");
  return scene;
}

}  // namespace ogc::experiments
