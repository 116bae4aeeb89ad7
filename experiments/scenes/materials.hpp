// Materials that several scenes share.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Of the authors' layers: density, membrane, bending and damping; k_c = 100 N/m, μ_c = 0.2.
compare::Material layer_cloth();

/// Of what is fixed or moves as it is told, in Table 1's scenes with a body: no energies, k_c = 100 N/m, μ_c = 0.5.
compare::Material driven_surface();

/// Of a solid whose file says nothing, decided here: 1000 kg/m³, E = 10⁵ Pa, ν = 0.4, as soft as foam rubber; damping
/// 2 ms, so that what fell comes to rest; μ_c = 0.5.
compare::Material soft_rubber();

}  // namespace ogc::experiments
