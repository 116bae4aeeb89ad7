// Materials that several scenes share.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Of the authors' layers: density, membrane, bending and damping; k_c = 100 N/m, μ_c = 0.2.
compare::Material layer_cloth();

/// Of what is fixed or moves as it is told, in Table 1's scenes with a body: no energies, k_c = 100 N/m, μ_c = 0.5.
compare::Material driven_surface();

}  // namespace ogc::experiments
