// St. Venant–Kirchhoff membrane, plane stress: ψ = A (λ/2 tr(G)² + μ ‖G‖²), G = (FᵀF − I)/2, damping ψ_d = (k_d/h) ψ(G
// − Gᵗ) (method.md §4.6, §4.9), seen from one corner. F = Σ x_k ∇N_kᵀ is 3×2; everything is written in differences to
// that corner, so that only relative coordinates are rounded.
#pragma once

#include "compare/problem/scene.hpp"
#include "fast/kernels/accumulator.hpp"
#include "fast/kernels/qualifiers.hpp"
#include "fast/kernels/scalar.hpp"
#include "fast/kernels/vector.hpp"

namespace ogc::fast {

/// Of one body. Damping already divided by the step: k_d/h [1].
struct alignas(16) SurfaceMaterial {
  float lame_lambda = 0, lame_mu = 0;  ///< [N/m]
  float membrane_damping = 0, bending_damping = 0;
};

/// Which models a body has. Only scenes that have others than the default ones read it.
struct SurfaceModels {
  compare::MembraneModel membrane = compare::MembraneModel::st_venant_kirchhoff;
  compare::BendingModel bending = compare::BendingModel::discrete_hinge;
  compare::DampingForm damping = compare::DampingForm::strain;
};

struct TriangleRest {
  int corner[3] = {-1, -1, -1};
  int body = -1;
  float gradient[3][2] = {};  ///< ∇N_k [1/m]
  float area = 0;             ///< A [m²]
};

/// Symmetric 2×2: a strain [1] or stress [N/m].
template <class T>
struct Symmetric2Of {
  T xx{}, xy{}, yy{};
};
using Symmetric2 = Symmetric2Of<float>;

/// The two columns of F.
template <class T>
struct DeformationGradientOf {
  Vector<T> first, second;
};
using DeformationGradient = DeformationGradientOf<float>;

/// From the edges x_b − x_a, x_c − x_a and the gradients of N_b and N_c.
template <class T>
OGC_HD DeformationGradientOf<T> deformation_gradient(const Vector<T>& to_b, const Vector<T>& to_c, const T* gradient_b,
                                                     const T* gradient_c) {
  return {gradient_b[0] * to_b + gradient_c[0] * to_c, gradient_b[1] * to_b + gradient_c[1] * to_c};
}

/// G = (FᵀF − I)/2; the diagonal as (‖f‖ − 1)(‖f‖ + 1)/2 would need a root, the plain form loses u, which is u of a
/// stress of stiffness λ.
template <class T>
OGC_HD Symmetric2Of<T> green_strain(const DeformationGradientOf<T>& f) {
  return {0.5f * (dot(f.first, f.first) - 1.0f), 0.5f * dot(f.first, f.second),
          0.5f * (dot(f.second, f.second) - 1.0f)};
}

/// S = λ tr(G) I + 2μ G [N/m].
template <class T>
OGC_HD Symmetric2Of<T> membrane_stress(const SurfaceMaterial& material, const Symmetric2Of<T>& strain) {
  const T trace = material.lame_lambda * (strain.xx + strain.yy);
  return {trace + 2 * material.lame_mu * strain.xx, 2 * material.lame_mu * strain.xy,
          trace + 2 * material.lame_mu * strain.yy};
}

/// ψ/A [J/m²], in double: energies are only reported.
OGC_HD inline double membrane_energy_density(const SurfaceMaterial& material, const Symmetric2& strain) {
  const double xx = strain.xx, xy = strain.xy, yy = strain.yy, trace = xx + yy;
  return 0.5 * material.lame_lambda * trace * trace + material.lame_mu * (xx * xx + 2 * xy * xy + yy * yy);
}

/// One triangle seen from its corner a; b and c follow in the triangle's order.
template <class T>
struct MembraneStencilOf {
  T gradient_b[2], gradient_c[2];  ///< ∇N_b, ∇N_c [1/m]; ∇N_a = −∇N_b − ∇N_c
  T area;                          ///< [m²]
};
using MembraneStencil = MembraneStencilOf<float>;

/// Adds −∂ψ/∂x_a and the 3×3 block: A (1 + k_d/h) ((λ+μ) (F∇N_a)(F∇N_a)ᵀ + μ ‖∇N_a‖² F Fᵀ) + A max(0, ∇N_aᵀ S ∇N_a) I.
/// `strain_start` is Gᵗ.
template <class T>
OGC_HD void add_membrane(const MembraneStencilOf<T>& stencil, const SurfaceMaterial& material, const Vector<T>& to_b,
                         const Vector<T>& to_c, const Symmetric2Of<T>& strain_start, ForceAndBlockOf<T>& sum) {
  const DeformationGradientOf<T> f = deformation_gradient(to_b, to_c, stencil.gradient_b, stencil.gradient_c);
  const T own_x = -(stencil.gradient_b[0] + stencil.gradient_c[0]),
          own_y = -(stencil.gradient_b[1] + stencil.gradient_c[1]);
  const Symmetric2Of<T> strain = green_strain(f), elastic = membrane_stress(material, strain);
  const Symmetric2Of<T> change{strain.xx - strain_start.xx, strain.xy - strain_start.xy, strain.yy - strain_start.yy};
  const Symmetric2Of<T> viscous = membrane_stress(material, change);
  const float damping = material.membrane_damping;
  const T pull_x = (elastic.xx + damping * viscous.xx) * own_x + (elastic.xy + damping * viscous.xy) * own_y;
  const T pull_y = (elastic.xy + damping * viscous.xy) * own_x + (elastic.yy + damping * viscous.yy) * own_y;
  sum.add_force(-stencil.area, pull_x * f.first + pull_y * f.second);

  const Vector<T> along = own_x * f.first + own_y * f.second;
  const T weight = stencil.area * (1.0f + damping),
          around = weight * material.lame_mu * (own_x * own_x + own_y * own_y);
  sum.add_outer(weight * (material.lame_lambda + material.lame_mu), along);
  sum.add_outer(around, f.first);
  sum.add_outer(around, f.second);
  const T geometric = own_x * (elastic.xx * own_x + elastic.xy * own_y) +
                      own_y * (elastic.xy * own_x + elastic.yy * own_y);
  sum.add_identity(stencil.area * select(geometric > T{}, geometric, T{}));
}

}  // namespace ogc::fast
