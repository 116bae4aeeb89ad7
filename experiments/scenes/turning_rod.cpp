#include "experiments/scenes/turning_rod.hpp"

#include <vector>

namespace ogc::experiments {

using compare::Index;

compare::Scene turning_rod(const TurningRodSizes& sizes) {
  constexpr double segment = 1e-3;
  compare::Mesh mesh;
  std::vector<compare::Vec3> velocities;
  compare::Scene scene;
  scene.name = "turning_rod";
  scene.gravity = {0, 0, 0};
  for (Index k = 0; k <= sizes.segments; ++k) {
    const double x = segment * (k - 0.5 * sizes.segments);
    mesh.positions.push_back({x, 0, 0});
    velocities.push_back({0, sizes.rate * x, 0});
    if (k > 0) mesh.loose_edges.push_back({k - 1, k});
  }
  compare::Material yarn;
  yarn.rod = compare::RodMaterial{.density = 1e-3, .stretch = 0.1, .bend = 2e-7, .damping = 0, .diameter = 3e-3};
  append_body(scene, {.name = "rod", .material = yarn}, mesh);
  scene.velocities = velocities;
  scene.settings.time_step = 4e-4;
  scene.settings.steps = sizes.steps;
  scene.settings.iterations = 4;
  scene.settings.frame_steps = 20;
  scene.settings.contact_radius = 3e-3;
  return scene;
}

}  // namespace ogc::experiments
