// Stable Neo-Hookean membrane on F (3×2): ψ = A (μ/2 (‖F‖² − 2) − μ (J − 1) + (λ + μ)/2 (J − 1)²), J = ‖f₁ × f₂‖
// (compare/stages/membrane.hpp), seen from one corner. With the edges b, c to the other corners, q = |∇N_b × ∇N_c| and
// the normal n of b × c:
//
//   J = q ‖b × c‖,   ∂J/∂x = g = q (b − c) × n,   ∂²J/∂x² = ‖g‖²/J n nᵀ
//
// F itself would cancel where a triangle is thin. The block μ ‖∇N‖² I + (λ + μ) g gᵀ + ((λ + μ)(J − 1) − μ) ‖g‖²/J n nᵀ
// has n for an eigenvector, and only along n can it be negative.
#pragma once

#include <cmath>

#include "fast/kernels/models/membrane.hpp"

namespace ogc::fast {

/// J, n and q; `ratio` 0 where the triangle has collapsed as far as single precision can tell.
struct AreaRatio {
  Vec normal;                    ///< n, a unit vector; 0 where the triangle has collapsed
  float ratio = 0, density = 0;  ///< J [1], q [1/m²]
};

/// J, n and q of a triangle with the edges b, c and the gradients ∇N_b, ∇N_c.
OGC_HD inline AreaRatio area_ratio(const Vec& to_b, const Vec& to_c, const float* gradient_b, const float* gradient_c) {
  Vec normal = cross(to_b, to_c);
  float scale = fabsf(gradient_b[0] * gradient_c[1] - gradient_b[1] * gradient_c[0]);
  const float density = scale;
  // Of a triangle a millionth as large the square of the area underflows.
  if (!(dot(normal, normal) >= 0x1p-90f)) {
    normal = cross(0x1p40f * to_b, 0x1p40f * to_c);
    scale *= 0x1p-80f;
  }
  const float squared = dot(normal, normal);
  if (!(squared >= 0x1p-126f)) return {{}, 0, density};
  const float length = sqrtf(squared);
  return {(1.0f / length) * normal, scale * length, density};
}

/// MembraneModel::stable_neo_hookean.
struct StableNeoHookean {
  static constexpr bool is_default = false;  ///< GatherDefault and the packs of the CPU lack it

  /// Adds −∂ψ/∂x_a and the block, its eigenvalue along the normal as max(0, ·). A collapsed triangle has no J.
  OGC_HD static void add_elastic(const MembraneStencil& stencil, const SurfaceMaterial& material, const Vec& to_b,
                                 const Vec& to_c, ForceAndBlock& sum) {
    const float own_x = -(stencil.gradient_b[0] + stencil.gradient_c[0]),
                own_y = -(stencil.gradient_b[1] + stencil.gradient_c[1]);
    const float mu = material.lame_mu, area = stencil.area, around = mu * (own_x * own_x + own_y * own_y);
    const DeformationGradient f = deformation_gradient(to_b, to_c, stencil.gradient_b, stencil.gradient_c);
    const Vec along = own_x * f.first + own_y * f.second;
    const AreaRatio at = area_ratio(to_b, to_c, stencil.gradient_b, stencil.gradient_c);
    sum.add_identity(area * around);
    if (!(at.ratio > 0)) {
      sum.add_force(-area, mu * along);
      return;
    }
    const Vec growth = at.density * cross(to_b - to_c, at.normal);
    const float volume = material.lame_lambda + mu, pull = volume * (at.ratio - 1.0f) - mu;
    sum.add_force(-area, mu * along + pull * growth);
    sum.add_outer(area * volume, growth);
    const float lift = pull * (dot(growth, growth) / at.ratio);
    sum.add_outer(area * (lift > -around ? lift : -around), at.normal);
  }

  /// The same and the damping of strains. `strain_start` is Gᵗ.
  OGC_HD static void add(const MembraneStencil& stencil, const SurfaceMaterial& material, const Vec& to_b,
                         const Vec& to_c, const Symmetric2& strain_start, ForceAndBlock& sum) {
    add_elastic(stencil, material, to_b, to_c, sum);
    if (material.membrane_damping > 0) add_strain_damping(stencil, material, to_b, to_c, strain_start, sum);
  }

  /// ψ [J], in double: energies are only reported. To corners 1 and 2 from corner 0.
  OGC_HD static double energy(const TriangleRest& rest, const SurfaceMaterial& material, const Vec& to_b,
                              const Vec& to_c) {
    const DeformationGradient f = deformation_gradient(to_b, to_c, rest.gradient[1], rest.gradient[2]);
    const float ratio = area_ratio(to_b, to_c, rest.gradient[1], rest.gradient[2]).ratio;
    const double grown = static_cast<double>(ratio) - 1.0, mu = material.lame_mu;
    const double squares = static_cast<double>(dot(f.first, f.first)) + static_cast<double>(dot(f.second, f.second));
    return rest.area * (0.5 * mu * (squares - 2.0) - mu * grown + 0.5 * (material.lame_lambda + mu) * grown * grown);
  }
};

}  // namespace ogc::fast
