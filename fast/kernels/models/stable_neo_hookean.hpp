// Adds a stable Neo-Hookean membrane on F (3×2) as one corner sees it: ψ = A (μ/2 (‖F‖² − 2) − μ (J − 1) + (λ + μ)/2 (J
// − 1)²), J = ‖f₁ × f₂‖ (compare/stages/membrane.hpp). With the edges b, c to the other corners, q = |∇N_b × ∇N_c| and
// the normal n of b × c:
//
//   J = q ‖b × c‖,   ∂J/∂x = g = q (b − c) × n,   ∂²J/∂x² = ‖g‖²/J n nᵀ
//
// These formulas avoid F, where terms cancel in a thin triangle. The block is μ ‖∇N‖² I + (λ + μ) g gᵀ + ((λ + μ)(J −
// 1) − μ) ‖g‖²/J n nᵀ. It has n as an eigenvector, and only the eigenvalue of n can be negative.
#pragma once

#include <cmath>

#include "fast/kernels/models/membrane.hpp"

namespace ogc::fast {

/// Holds J, n and q of a triangle (head of this file). `ratio` is 0 if the triangle has collapsed in single precision.
template <class T>
struct AreaRatioOf {
  Vector<T> normal;      ///< n, a unit vector; 0 if the triangle has collapsed
  T ratio{}, density{};  ///< J [1], q [1/m²]
};

/// Returns J, n and q of a triangle with the edges b, c and the gradients ∇N_b, ∇N_c.
template <class T>
OGC_HD AreaRatioOf<T> area_ratio(const Vector<T>& to_b, const Vector<T>& to_c, const T* gradient_b,
                                 const T* gradient_c) {
  Vector<T> normal = cross(to_b, to_c);
  T scale = absolute(gradient_b[0] * gradient_c[1] - gradient_b[1] * gradient_c[0]);
  const T density = scale;
  // Scales the edges by 2⁴⁰ if the square of the area might underflow.
  const Mask<T> is_tiny = dot(normal, normal) < 0x1p-90f;
  if (!is_false(is_tiny)) {
    const T large = T{} + 0x1p40f;
    normal = select(is_tiny, cross(large * to_b, large * to_c), normal);
    scale = select(is_tiny, 0x1p-80f * scale, scale);
  }
  const T squared = dot(normal, normal);
  const Mask<T> is_flat = squared < 0x1p-126f;
  const T length = root(squared), zero{};
  return {select(is_flat, Vector<T>{}, (1.0f / length) * normal), select(is_flat, zero, scale * length), density};
}

/// Implements MembraneModel::stable_neo_hookean.
struct StableNeoHookean {
  /// Adds −∂ψ/∂x_a and the block. If the block's eigenvalue along the normal is negative, it is replaced by 0. A
  /// collapsed triangle has n = 0, so all terms with J vanish.
  template <class T>
  OGC_HD static void add_elastic(const MembraneStencilOf<T>& stencil, const SurfaceMaterial& material,
                                 const Vector<T>& to_b, const Vector<T>& to_c, ForceAndBlockOf<T>& sum) {
    const T own_x = -(stencil.gradient_b[0] + stencil.gradient_c[0]),
            own_y = -(stencil.gradient_b[1] + stencil.gradient_c[1]);
    const float mu = material.lame_mu, volume = material.lame_lambda + mu;
    const T area = stencil.area, around = mu * (own_x * own_x + own_y * own_y);
    const DeformationGradientOf<T> f = deformation_gradient(to_b, to_c, stencil.gradient_b, stencil.gradient_c);
    const Vector<T> along = own_x * f.first + own_y * f.second;
    const AreaRatioOf<T> at = area_ratio(to_b, to_c, stencil.gradient_b, stencil.gradient_c);
    const Vector<T> growth = at.density * cross(to_b - to_c, at.normal);
    const T pull = volume * (at.ratio - 1.0f) - mu, one = T{} + 1.0f;
    sum.add_force(-area, (T{} + mu) * along + pull * growth);
    sum.add_identity(area * around);
    sum.add_outer(area * volume, growth);
    const T lift = pull * (dot(growth, growth) / select(at.ratio > T{}, at.ratio, one));
    sum.add_outer(area * select(lift > -around, lift, -around), at.normal);
  }

  /// Adds the same as add_elastic, and the damping of strains. `strain_start` is Gᵗ.
  template <class T>
  OGC_HD static void add(const MembraneStencilOf<T>& stencil, const SurfaceMaterial& material, const Vector<T>& to_b,
                         const Vector<T>& to_c, const Symmetric2Of<T>& strain_start, ForceAndBlockOf<T>& sum) {
    add_elastic(stencil, material, to_b, to_c, sum);
    if (material.membrane_damping > 0) add_strain_damping(stencil, material, to_b, to_c, strain_start, sum);
  }

  /// Returns ψ [J], in double because it is only reported. The edges go from corner 0 to corners 1 and 2.
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
