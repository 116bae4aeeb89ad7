// Isometric quadratic bending of a flat rest shape: c/2 ‖ℓ‖², ℓ = Σ w_i x_i (compare/stages/bending.hpp), seen from one
// vertex. The weights add up to 0, so ℓ is formed from differences to that vertex. Damping is the hinge's
// (bending.hpp), with θᵗ for a rest angle.
#pragma once

#include "fast/kernels/bending.hpp"

namespace ogc::fast {

/// w of x1, o0, o1 [1/m]; that of x0 is minus their sum.
struct HingeWeights {
  float weight[3] = {};
};

/// w of the vertex itself and of the others in the order of its hinge incidence [1/m].
struct IsometricStencil {
  float own = 0, other[3] = {};
};

/// Adds −c w ℓ and c w² I; `to`: from the vertex to the others.
OGC_HD inline void add_isometric(const IsometricStencil& stencil, float stiffness, const Vec* to, ForceAndBlock& sum) {
  const Vec curvature = stencil.other[0] * to[0] + stencil.other[1] * to[1] + stencil.other[2] * to[2];
  const float pull = stiffness * stencil.own;
  sum.add_force(-pull, curvature);
  sum.add_identity(pull * stencil.own);
}

/// [J], in double: energies are only reported. `to`: from x0 to x1, o0, o1.
OGC_HD inline double isometric_energy(const HingeRest& rest, const HingeWeights& weights, const Vec* to) {
  const Vec curvature = weights.weight[0] * to[0] + weights.weight[1] * to[1] + weights.weight[2] * to[2];
  return 0.5 * rest.stiffness * static_cast<double>(dot(curvature, curvature));
}

}  // namespace ogc::fast
