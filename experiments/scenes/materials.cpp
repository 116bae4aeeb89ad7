#include "experiments/scenes/materials.hpp"

namespace ogc::experiments {

compare::Material driven_surface() {
  compare::Material material;
  material.membrane = compare::MembraneModel::none;
  material.bending = compare::BendingModel::none;
  material.lame_mu = material.lame_lambda = material.bending_stiffness = 0;
  material.contact_stiffness = 100;
  material.friction = 0.5;
  return material;
}

}  // namespace ogc::experiments
