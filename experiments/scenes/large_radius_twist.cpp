// The size, the radius and the rotation by 180° are from the paper's caption. Our choice: half of twist's angular
// velocity, twist's time step, and as many iterations as dress. The tolerance of the solver IPC is that of
// Codimensional IPC's scripts.
#include "experiments/scenes/large_radius_twist.hpp"

#include "compare/problem/readers.hpp"
#include "experiments/scenes/twist.hpp"

namespace ogc::experiments {

compare::Scene large_radius_twist(const LargeRadiusTwistSizes& sizes) {
  compare::Scene scene = twist({sizes.vertices_a_side, sizes.steps});
  scene.name = "large_radius_twist";
  for (compare::PrescribedMotion& motion : scene.motions) motion.angular_velocity /= 2;
  scene.settings.iterations = 20;
  scene.settings.contact_radius = 5e-3 * 199 / (sizes.vertices_a_side - 1);
  set_declared(scene.settings, "ipc_distance", scene.settings.contact_radius);
  set_declared(scene.settings, "ipc_stopping", "velocity");
  set_declared(scene.settings, "ipc_ccd", "full");
  return scene;
}

}  // namespace ogc::experiments
