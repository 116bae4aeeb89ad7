// Adds a St. Venant–Kirchhoff membrane in plane stress as one corner sees it: ψ = A (λ/2 tr(G)² + μ ‖G‖²) (method.md
// §4.6).
#pragma once

#include "fast/kernels/models/membrane.hpp"

namespace ogc::fast {

/// Implements MembraneModel::st_venant_kirchhoff.
struct StVenantKirchhoff {
  /// Adds the force −∂ψ/∂x_a with damping of strains, and the 3×3 block A (1 + k_d/h) ((λ+μ) (F∇N_a)(F∇N_a)ᵀ + μ
  /// ‖∇N_a‖² F Fᵀ) + A max(0, ∇N_aᵀ S ∇N_a) I. `strain_start` is Gᵗ.
  template <class T>
  OGC_HD static void add(const MembraneStencilOf<T>& stencil, const SurfaceMaterial& material, const Vector<T>& to_b,
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

  /// Does the same as `add` for a membrane without damping.
  OGC_HD static void add_elastic(const MembraneStencil& stencil, SurfaceMaterial material, const Vec& to_b,
                                 const Vec& to_c, ForceAndBlock& sum) {
    material.membrane_damping = 0;
    add(stencil, material, to_b, to_c, {}, sum);
  }

  /// Returns ψ [J], in double because it is only reported. The edges go from corner 0 to corners 1 and 2.
  OGC_HD static double energy(const TriangleRest& rest, const SurfaceMaterial& material, const Vec& to_b,
                              const Vec& to_c) {
    const Symmetric2 strain = green_strain(deformation_gradient(to_b, to_c, rest.gradient[1], rest.gradient[2]));
    const double xx = strain.xx, xy = strain.xy, yy = strain.yy, trace = xx + yy;
    return rest.area *
           (0.5 * material.lame_lambda * trace * trace + material.lame_mu * (xx * xx + 2 * xy * xy + yy * yy));
  }
};

}  // namespace ogc::fast
