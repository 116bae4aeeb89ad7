#include "experiments/scenes/materials.hpp"

#include "compare/problem/material_table.hpp"

namespace ogc::experiments {

compare::Material layer_cloth() {
  compare::Material material;
  material.density = 0.2;
  material.lame_mu = material.lame_lambda = 10;
  material.bending_stiffness = 5e-7;
  material.membrane_damping = material.bending_damping = 2e-6;
  material.contact_stiffness = 100;
  material.friction = 0.2;
  return material;
}

compare::Material driven_surface() {
  compare::Material material;
  material.membrane = compare::MembraneModel::none;
  material.bending = compare::BendingModel::none;
  material.lame_mu = material.lame_lambda = material.bending_stiffness = 0;
  material.contact_stiffness = 100;
  material.friction = 0.5;
  return material;
}

compare::Material soft_rubber() {
  compare::Material material;
  material.solid_density = 1000;
  compare::set_elasticity(material, {1e5, 0.4});
  material.solid_damping = 2e-3;
  material.friction = 0.5;
  return material;
}

}  // namespace ogc::experiments
