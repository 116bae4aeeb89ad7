// Defines the constants and models that a body of surfaces has.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::fast {

/// Constants of one body. Damping is already divided by the step: k_d/h [1].
struct alignas(16) SurfaceMaterial {
  float lame_lambda = 0, lame_mu = 0;               ///< λ, μ [N/m]
  float membrane_damping = 0, bending_damping = 0;  ///< k_d/h [1] of membranes and of hinges
};

/// Models of a body; only read if some body of the scene has a model other than the default.
struct SurfaceModels {
  compare::MembraneModel membrane = compare::MembraneModel::st_venant_kirchhoff;  ///< method.md §4.6
  compare::BendingModel bending = compare::BendingModel::discrete_hinge;          ///< method.md §4.7
  /// form of damping, also for the body's springs and tetrahedra (method.md §4.9)
  compare::DampingForm damping = compare::DampingForm::strain;
};

}  // namespace ogc::fast
