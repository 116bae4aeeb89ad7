// Numbers are the paper's Table 1; materials are those of cloth_on_sphere. The figure shows the last step.
#include "experiments/scenes/three_cloths_on_sphere.hpp"

#include "compare/problem/readers.hpp"
#include "experiments/scenes/cloth_on_sphere.hpp"
#include "experiments/scenes/shapes.hpp"

namespace ogc::experiments {

compare::Scene three_cloths_on_sphere(const ThreeClothsSizes& sizes) {
  compare::Scene scene;
  scene.name = "three_cloths_on_sphere";
  const double radius = 2e-3 * 69 / (sizes.vertices_a_side - 1);
  for (int layer = 0; layer < 3; ++layer)
    append_body(scene, {.name = "cloth_" + std::to_string(layer + 1), .material = sphere_scene_material()},
                grid(sizes.vertices_a_side, 1, 0.30 + 2 * layer * radius));
  append_sphere(scene, sizes.sphere_subdivisions);
  scene.settings.time_step = 1.0 / 100;
  scene.settings.steps = sizes.steps;
  scene.settings.iterations = sizes.iterations;
  set_declared(scene.settings, "newton_iterations", 50);
  scene.settings.contact_radius = radius;
  return scene;
}

}  // namespace ogc::experiments
