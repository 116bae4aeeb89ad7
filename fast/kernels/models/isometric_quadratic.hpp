// Adds isometric quadratic bending of a flat rest shape as one vertex sees it: c/2 ‖ℓ‖² with ℓ = Σ w_i x_i
// (compare/stages/bending.hpp). The weights add up to 0, so ℓ is computed from differences to this vertex. The damping
// is the energy of a discrete hinge with θᵗ as its rest angle.
#pragma once

#include "fast/kernels/models/discrete_hinge.hpp"

namespace ogc::fast {

/// Implements BendingModel::isometric_quadratic.
struct IsometricQuadratic {
  /// UsualHinges and the SIMD code of the CPU do not compute this model, and it needs HingeWeights.
  static constexpr bool is_default = false;
  static constexpr bool reads_weights = true;

  /// Adds the force −c w ℓ and the block c w² I, without damping. w is the weight of the vertex; the head of this file
  /// defines c and ℓ.
  OGC_HD static void add(const HingeSeen& hinge, float, ForceAndBlock& sum) {
    const Vec to[3] = {hinge.p[0] - hinge.own, hinge.p[1] - hinge.own, hinge.p[2] - hinge.own};
    const float* w = hinge.isometric.other;
    const Vec curvature = w[0] * to[0] + w[1] * to[1] + w[2] * to[2];
    const float pull = hinge.stencil.stiffness * hinge.isometric.own;
    sum.add_force(-pull, curvature);
    sum.add_identity(pull * hinge.isometric.own);
  }

  /// Adds the damping of a discrete hinge; `damping` is k_d/h.
  OGC_HD static void add_damper(const HingeSeen& hinge, float damping, ForceAndBlock& sum) {
    if (!(damping > 0)) return;
    HingeSeen damper = hinge;
    damper.stencil = {damping * hinge.stencil.stiffness, hinge.angle_start};
    DiscreteHinge::add(damper, 0.0f, sum);
  }

  /// Returns the energy [J], in double because it is only reported. `to` holds x1, o0 and o1 minus x0.
  OGC_HD static double energy(const HingeRest& rest, const HingeWeights& weights, const Vec* to) {
    const Vec curvature = weights.weight[0] * to[0] + weights.weight[1] * to[1] + weights.weight[2] * to[2];
    return 0.5 * rest.stiffness * static_cast<double>(dot(curvature, curvature));
  }
};

}  // namespace ogc::fast
