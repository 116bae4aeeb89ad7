// r, k_c, friction, steps and h are from the paper's Table 1 and Fig. 19. Size and material are from IPC's mat scene
// (Li et al. 2020). The angular velocity of each end is our choice: the paper does not say whether its π/2 belongs to
// each end or to one end relative to the other.
#include "experiments/scenes/mat_twist.hpp"

#include <numbers>

#include "compare/problem/material_table.hpp"
#include "experiments/scenes/solid_box.hpp"

namespace ogc::experiments {
namespace {

constexpr double mat_thickness = 8.333e-3, mat_radius = 2e-3;  ///< [m], for 88 vertices on 1 m
constexpr double young = 2e4, poisson = 0.4;                   ///< [Pa], [1]

/// Returns the material. The energies of surfaces keep their defaults, because they do not act on a solid's surface.
compare::Material soft_solid() {
  compare::Material material;
  material.solid_density = 1000;
  compare::set_elasticity(material, {young, poisson});
  material.contact_stiffness = 100;
  material.friction = 0.2;
  return material;
}

/// Returns the motion of all vertices of one column, rotated about the x axis. A column has 2 × `across` vertices.
compare::PrescribedMotion handle(const char* name, compare::Index column, compare::Index across,
                                 double angular_velocity) {
  compare::PrescribedMotion motion;
  motion.name = name;
  for (compare::Index k = 0; k < 2 * across; ++k) motion.vertices.push_back(column * 2 * across + k);
  motion.axis = {1, 0, 0};
  motion.angular_velocity = angular_velocity;
  return motion;
}

}  // namespace

compare::Scene mat_twist(const MatTwistSizes& sizes) {
  const double coarser = 87.0 / (sizes.along - 1), half = mat_thickness * coarser / 2;
  compare::Scene scene;
  scene.name = "mat_twist";
  append_body(scene, {.name = "mat", .material = soft_solid()},
              solid_box({sizes.along, 2, sizes.across}, {-0.5, -half, -0.5}, {0.5, half, 0.5}));
  scene.motions.push_back(handle("left", 0, sizes.across, std::numbers::pi / 2));
  scene.motions.push_back(handle("right", sizes.along - 1, sizes.across, -std::numbers::pi / 2));
  scene.gravity = {};
  scene.settings.time_step = 1.0 / 240;
  scene.settings.steps = sizes.steps;
  scene.settings.iterations = 20;
  scene.settings.contact_radius = mat_radius * coarser;
  scene.settings.friction_velocity = 1e-2;
  return scene;
}

}  // namespace ogc::experiments
