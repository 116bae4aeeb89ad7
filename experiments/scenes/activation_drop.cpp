// Numbers are the paper's Table 1, with the contact radius of cloth_on_sphere. The number of iterations is only a
// limit, because each step ends at its tolerance.
#include "experiments/scenes/activation_drop.hpp"

#include "compare/problem/readers.hpp"
#include "experiments/scenes/cloth_on_sphere.hpp"
#include "experiments/scenes/shapes.hpp"

namespace ogc::experiments {

compare::Scene activation_drop(const ActivationDropSizes& sizes) {
  compare::Scene scene = cloth_on_sphere({sizes.vertices_a_side, sizes.sphere_subdivisions, sizes.steps});
  scene.name = "activation_drop";
  append_body(scene, {.name = "ground", .fixed = true, .material = sphere_scene_material()},
              ground(sizes.vertices_a_side, -0.272));
  scene.settings.iterations = sizes.iterations;
  scene.settings.detection_fraction = 0;
  set_declared(scene.settings, "newton_iterations", 200);
  return scene;
}

}  // namespace ogc::experiments
