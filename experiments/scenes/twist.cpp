// Numbers are the paper's Table 1 and the authors' published parameters. We take the paper's 8 turns as rotations of
// one end relative to the other (our choice).
#include "experiments/scenes/twist.hpp"

#include <numbers>

#include "experiments/scenes/shapes.hpp"

namespace ogc::experiments {
namespace {

compare::Material cloth() {
  compare::Material material;
  material.density = 0.2;
  material.lame_mu = material.lame_lambda = 10;
  material.bending_stiffness = 1e-6;
  material.membrane_damping = 3e-5;
  material.bending_damping = 2e-4;
  material.contact_stiffness = 100;
  material.friction = 0.2;
  return material;
}

// Returns the motion of all vertices of one column of the sheet, rotated about the x axis.
compare::PrescribedMotion handle(const char* name, compare::Index column, compare::Index count,
                                 double angular_velocity) {
  compare::PrescribedMotion motion;
  motion.name = name;
  for (compare::Index j = 0; j < count; ++j) motion.vertices.push_back(column * count + j);
  motion.axis = {1, 0, 0};
  motion.angular_velocity = angular_velocity;
  return motion;
}

}  // namespace

compare::Scene twist(const TwistSizes& sizes) {
  const compare::Index count = sizes.vertices_a_side;
  compare::Scene scene;
  scene.name = "twist";
  append_body(scene, {.name = "cloth", .material = cloth()}, grid(count, 1, 0));
  scene.motions.push_back(handle("left", 0, count, std::numbers::pi / 4));
  scene.motions.push_back(handle("right", count - 1, count, -std::numbers::pi / 4));
  scene.gravity = {};
  scene.settings.time_step = 1.0 / 300;
  scene.settings.steps = sizes.steps;
  scene.settings.iterations = 10;
  scene.settings.contact_radius = 2e-3 * 99 / (count - 1);
  return scene;
}

}  // namespace ogc::experiments
