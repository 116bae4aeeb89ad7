// Adds a discrete hinge as one vertex sees it. Its energy is c/2 (θ − θ₀)² with c = k_b 3‖ē‖²/(Ā₀ + Ā₁) (method.md
// §4.7), its damping c k_d/(2h) (θ − θᵗ)². The block is the Gauss–Newton approximation.
#pragma once

#include "fast/kernels/models/hinge.hpp"

namespace ogc::fast {

/// Implements BendingModel::discrete_hinge.
struct DiscreteHinge {
  static constexpr bool is_default = true;      ///< whether UsualHinges and the SIMD code of the CPU compute this model
  static constexpr bool reads_weights = false;  ///< whether it needs HingeWeights

  /// Adds −∂/∂x of energy and damping, and the block c (1 + k_d/h) ∇θ ∇θᵀ. `gradient` is ∂θ/∂x of the vertex,
  /// `angle_start` θᵗ, `damping` k_d/h.
  template <class T>
  OGC_HD static void add(const HingeStencilOf<T>& stencil, float damping, const T& angle, const T& angle_start,
                         const Vector<T>& gradient, ForceAndBlockOf<T>& sum) {
    const T moment = stencil.stiffness * ((angle - stencil.rest_angle) + damping * (angle - angle_start));
    sum.add_force(-moment, gradient);
    sum.add_outer(stencil.stiffness * (1.0f + damping), gradient);
  }

  /// Adds hinges as a vertex at `own` sees them; adds nothing for a collapsed hinge.
  template <class T>
  OGC_HD static void add(const HingeReadsOf<T>& hinge, float damping, const Vector<T>& own, ForceAndBlockOf<T>& sum) {
    const HingeShapeOf<T> shape = hinge_shape_seen<T>(hinge.opposite, hinge.p, own);
    add_where(shape.defined, sum, [&](ForceAndBlockOf<T>& to) {
      add(hinge.stencil, damping, shape.angle, hinge.angle_start, hinge_gradient(shape, hinge.opposite), to);
    });
  }
  OGC_HD static void add(const HingeSeen& hinge, float damping, ForceAndBlock& sum) {
    add(hinge, damping, hinge.own, sum);
  }

  /// Adds nothing: `add` includes all damping.
  OGC_HD static void add_damper(const HingeSeen&, float, ForceAndBlock&) {}

  /// Returns the energy [J], in double because it is only reported. `to` holds x1, o0 and o1 minus x0.
  OGC_HD static double energy(const HingeRest& rest, const HingeWeights&, const Vec* to) {
    const HingeShape shape = hinge_shape(to[0], to[1], to[2]);
    if (!shape.defined) return 0;
    const double change = static_cast<double>(shape.angle) - rest.angle;
    return 0.5 * rest.stiffness * change * change;
  }
};

}  // namespace ogc::fast
