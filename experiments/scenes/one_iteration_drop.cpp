// Numbers are from the paper's caption; sphere and frames are our choice; materials are those of cloth_on_sphere.
#include "experiments/scenes/one_iteration_drop.hpp"

#include "compare/problem/readers.hpp"
#include "experiments/scenes/cloth_on_sphere.hpp"

namespace ogc::experiments {

compare::Scene one_iteration_drop(const OneIterationDropSizes& sizes) {
  compare::Scene scene = cloth_on_sphere({sizes.vertices_a_side, sizes.sphere_subdivisions, sizes.steps, 0.10});
  scene.name = "one_iteration_drop";
  scene.settings.time_step = 1.0 / 500;
  scene.settings.frame_steps = 10;
  scene.settings.iterations = 1;
  for (const char* iterations : {"newton_iterations", "ipc_iterations"})
    set_declared(scene.settings, iterations, 1);
  for (const char* tolerance : {"newton_tolerance", "ipc_tolerance", "ipc_velocity_tolerance"})
    set_declared(scene.settings, tolerance, 0);
  return scene;
}

}  // namespace ogc::experiments
