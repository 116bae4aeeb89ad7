// Defines what all membrane models share: a triangle's rest data, F = Σ x_k ∇N_kᵀ (3×2), Green's strain G = (FᵀF −
// I)/2, and the damping energy (k_d/h) ψ(G − Gᵗ) with the quadratic ψ (method.md §4.6, §4.9). All formulas use
// differences to the corner that is updated, so that rounding errors are relative to edges, not to coordinates.
#pragma once

#include "fast/kernels/arithmetic/accumulator.hpp"
#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/scalar.hpp"
#include "fast/kernels/arithmetic/vector.hpp"
#include "fast/kernels/models/material.hpp"

namespace ogc::fast {

/// A triangle at rest.
struct TriangleRest {
  int corner[3] = {-1, -1, -1};  ///< vertices in the order of the mesh
  int body = -1;
  float gradient[3][2] = {};  ///< ∇N_k [1/m]
  float area = 0;             ///< A [m²]
};

/// A symmetric 2×2 matrix: a strain [1] or stress [N/m].
template <class T>
struct Symmetric2Of {
  T xx{}, xy{}, yy{};
};
using Symmetric2 = Symmetric2Of<float>;

/// The two columns of F.
template <class T>
struct DeformationGradientOf {
  Vector<T> first, second;  ///< f₁, f₂ [1]
};
using DeformationGradient = DeformationGradientOf<float>;

/// Returns F from the edges x_b − x_a, x_c − x_a and the gradients of N_b and N_c.
template <class T>
OGC_HD DeformationGradientOf<T> deformation_gradient(const Vector<T>& to_b, const Vector<T>& to_c, const T* gradient_b,
                                                     const T* gradient_c) {
  return {gradient_b[0] * to_b + gradient_c[0] * to_c, gradient_b[1] * to_b + gradient_c[1] * to_c};
}

/// Returns G = (FᵀF − I)/2. It errs by about 2⁻²⁴, so the stress errs by 2⁻²⁴ λ. (‖f‖ − 1)(‖f‖ + 1)/2 for the diagonal
/// would be more accurate but needs a root.
template <class T>
OGC_HD Symmetric2Of<T> green_strain(const DeformationGradientOf<T>& f) {
  return {0.5f * (dot(f.first, f.first) - 1.0f), 0.5f * dot(f.first, f.second),
          0.5f * (dot(f.second, f.second) - 1.0f)};
}

/// Returns S = λ tr(G) I + 2μ G [N/m].
template <class T>
OGC_HD Symmetric2Of<T> membrane_stress(const SurfaceMaterial& material, const Symmetric2Of<T>& strain) {
  const T trace = material.lame_lambda * (strain.xx + strain.yy);
  return {trace + 2 * material.lame_mu * strain.xx, 2 * material.lame_mu * strain.xy,
          trace + 2 * material.lame_mu * strain.yy};
}

/// A triangle as its corner a sees it; b and c follow in the triangle's order.
template <class T>
struct MembraneStencilOf {
  T gradient_b[2], gradient_c[2];  ///< ∇N_b, ∇N_c [1/m]; ∇N_a = −∇N_b − ∇N_c
  T area;                          ///< [m²]
};
using MembraneStencil = MembraneStencilOf<float>;

/// Adds damping of strains, whose energy is E = A (k_d/h) (λ/2 tr(ΔG)² + μ ‖ΔG‖²) with ΔG = G − Gᵗ: the force −∂E/∂x_a,
/// and the material part of ∂²E/∂x_a². `strain_start` is Gᵗ.
template <class T>
OGC_HD void add_strain_damping(const MembraneStencilOf<T>& stencil, const SurfaceMaterial& material,
                               const Vector<T>& to_b, const Vector<T>& to_c, const Symmetric2Of<T>& strain_start,
                               ForceAndBlockOf<T>& sum) {
  const DeformationGradientOf<T> f = deformation_gradient(to_b, to_c, stencil.gradient_b, stencil.gradient_c);
  const T own_x = -(stencil.gradient_b[0] + stencil.gradient_c[0]),
          own_y = -(stencil.gradient_b[1] + stencil.gradient_c[1]);
  const Symmetric2Of<T> strain = green_strain(f);
  const Symmetric2Of<T> viscous = membrane_stress(
      material, Symmetric2Of<T>{strain.xx - strain_start.xx, strain.xy - strain_start.xy, strain.yy - strain_start.yy});
  const T weight = stencil.area * material.membrane_damping,
          around = weight * material.lame_mu * (own_x * own_x + own_y * own_y);
  sum.add_force(-weight, (viscous.xx * own_x + viscous.xy * own_y) * f.first +
                             (viscous.xy * own_x + viscous.yy * own_y) * f.second);
  sum.add_outer(weight * (material.lame_lambda + material.lame_mu), own_x * f.first + own_y * f.second);
  sum.add_outer(around, f.first);
  sum.add_outer(around, f.second);
}

}  // namespace ogc::fast
