// Defines materials of several scenes.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Returns the material of the authors' layers: density, membrane, bending and damping; k_c = 100 N/m, μ_c = 0.2.
compare::Material layer_cloth();

/// Returns the material of fixed and driven bodies in the scenes dress and robot_shirt (Table 1): no energies, k_c =
/// 100 N/m, μ_c = 0.5.
compare::Material driven_surface();

/// Returns the material of a solid whose file has none (our choice): 1000 kg/m³, E = 10⁵ Pa, ν = 0.4, as soft as foam
/// rubber; μ_c = 0.5. A damping of 2 ms brings the solid to rest after a fall.
compare::Material soft_rubber();

}  // namespace ogc::experiments
