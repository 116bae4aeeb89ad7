// Adds a stable Neo-Hookean tetrahedron as one corner sees it (compare/stages/tetrahedron.hpp). a, b, c are the vectors
// to the other corners, ordered so that det(a, b, c) > 0 at rest. ∇N belongs to the corner itself, ∇N_k to the others.
// With n = (b − a) × (c − a), w_k = V ∇N_k·∇N and i = 1/(6V):
//
//   J = i n·a,   V ∂J/∂x = −n/6,   force −μ (w₁ a + w₂ b + w₃ c) + ((λ + μ)(J − 1) − μ) n/6,
//   block −μ (w₁ + w₂ + w₃) I + (λ + μ) i/6 n nᵀ
//
// Only damping needs F and V, so an incidence has four numbers of rest data.
#pragma once

#include "fast/kernels/arithmetic/accumulator.hpp"
#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/scalar.hpp"
#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// Constants of one body. Damping is already divided by the step: k_d/h [1].
struct alignas(16) SolidMaterial {
  float lame_lambda = 0, lame_mu = 0;  ///< [Pa]
  float damping = 0;                   ///< k_d/h [1]
};

/// A tetrahedron at rest (method.md §8.4).
struct TetrahedronRest {
  int corner[4] = {-1, -1, -1, -1};  ///< vertices, in the order of a positive volume at rest
  int body = -1;
  float weight[6] = {};       ///< V ∇N_k·∇N_l of the pairs 01, 02, 03, 12, 13, 23 [m]
  float inverse = 0;          ///< i = 1/(6 V) [1/m³]
  float gradient[3][3] = {};  ///< ∇N₁, ∇N₂, ∇N₃ [1/m], for the damping
  float volume = 0;           ///< V [m³], for the damping
};

/// A tetrahedron as one corner sees it.
template <class T>
struct TetrahedronStencilOf {
  T weight[3];  ///< w_k of the other corners [m]
  T inverse;    ///< i [1/m³]
};
using TetrahedronStencil = TetrahedronStencilOf<float>;

/// A symmetric 3×3 strain [1].
using SolidStrain = Symmetric3;

/// Holds the data that only damping of strains needs: V, and ∇N of the other corners. ∇N of the corner itself is minus
/// their sum.
struct TetrahedronGradients {
  Vec other[3];      ///< ∇N [1/m]
  float volume = 0;  ///< V [m³]
};

/// Adds the elastic force and block of the corner from which a, b and c are seen.
template <class T>
OGC_HD void add_tetrahedron(const TetrahedronStencilOf<T>& stencil, const SolidMaterial& material, const Vector<T>& a,
                            const Vector<T>& b, const Vector<T>& c, ForceAndBlockOf<T>& sum) {
  const float mu = material.lame_mu, bulk = material.lame_lambda + mu;
  const Vector<T> normal = cross(b - a, c - a);
  const T* w = stencil.weight;
  const T pull = bulk * (stencil.inverse * dot(normal, a) - 1.0f) - mu;
  sum.add_force(T{} - mu, w[0] * a + w[1] * b + w[2] * c);
  sum.add_force((1.0f / 6.0f) * pull, normal);
  sum.add_identity((T{} - mu) * (w[0] + w[1] + w[2]));
  sum.add_outer((bulk / 6.0f) * stencil.inverse, normal);
}

/// Holds the columns of the deformation gradient F.
struct SolidDeformation {
  Vec column[3];  ///< derivatives of x along the axes of the rest shape [1]
};

/// Returns F = Σ x_k ∇N_kᵀ, with a, b and c the vectors to the other corners.
OGC_HD inline SolidDeformation solid_deformation(const TetrahedronGradients& gradients, const Vec& a, const Vec& b,
                                                 const Vec& c) {
  const Vec* g = gradients.other;
  return {{g[0].x * a + g[1].x * b + g[2].x * c, g[0].y * a + g[1].y * b + g[2].y * c,
           g[0].z * a + g[1].z * b + g[2].z * c}};
}

/// Returns G = (FᵀF − I)/2.
OGC_HD inline SolidStrain solid_strain(const SolidDeformation& f) {
  const Vec *x = &f.column[0], *y = &f.column[1], *z = &f.column[2];
  return {0.5f * (dot(*x, *x) - 1.0f), 0.5f * dot(*x, *y), 0.5f * dot(*x, *z),
          0.5f * (dot(*y, *y) - 1.0f), 0.5f * dot(*y, *z), 0.5f * (dot(*z, *z) - 1.0f)};
}

/// Returns F v for a vector v of the rest shape.
OGC_HD inline Vec along_columns(const SolidDeformation& f, const Vec& by) {
  return by.x * f.column[0] + by.y * f.column[1] + by.z * f.column[2];
}

/// Adds damping of strains: the force −∂/∂x of V (k_d/h) (λ/2 tr(ΔG)² + μ ‖ΔG‖²), ΔG = G − Gᵗ, and the block V (k_d/h)
/// ((λ + μ)(F∇N)(F∇N)ᵀ + μ ‖∇N‖² F Fᵀ), its material part. x and ∇N are those of the corner from which a, b and c are
/// seen.
OGC_HD inline void add_solid_damping(const TetrahedronGradients& gradients, const SolidMaterial& material, const Vec& a,
                                     const Vec& b, const Vec& c, const SolidStrain& start, ForceAndBlock& sum) {
  const SolidDeformation f = solid_deformation(gradients, a, b, c);
  const SolidStrain now = solid_strain(f);
  const Vec own = -(gradients.other[0] + gradients.other[1] + gradients.other[2]);
  const float mu = material.lame_mu,
              trace = material.lame_lambda * ((now.xx - start.xx) + (now.yy - start.yy) + (now.zz - start.zz));
  const float xx = trace + 2 * mu * (now.xx - start.xx), yy = trace + 2 * mu * (now.yy - start.yy),
              zz = trace + 2 * mu * (now.zz - start.zz), xy = 2 * mu * (now.xy - start.xy),
              xz = 2 * mu * (now.xz - start.xz), yz = 2 * mu * (now.yz - start.yz);
  const Vec pull{xx * own.x + xy * own.y + xz * own.z, xy * own.x + yy * own.y + yz * own.z,
                 xz * own.x + yz * own.y + zz * own.z};
  const float weight = gradients.volume * material.damping, around = weight * mu * dot(own, own);
  sum.add_force(-weight, along_columns(f, pull));
  sum.add_outer(weight * (material.lame_lambda + mu), along_columns(f, own));
  for (const Vec& column : f.column) sum.add_outer(around, column);
}

/// Returns J = i det(a, b, c), in double because it is only reported.
OGC_HD inline double volume_ratio(const TetrahedronRest& rest, const Vec& a, const Vec& b, const Vec& c) {
  const Vector<double> p{a.x, a.y, a.z}, q{b.x, b.y, b.z}, r{c.x, c.y, c.z};
  return rest.inverse * dot(p, cross(q, r));
}

/// Returns V ψ [J]. The term V (‖F‖² − 3) is computed from positions, so it errs by about 2⁻²² V. With displacements, F
/// − I, no digits would cancel.
OGC_HD inline double solid_energy(const TetrahedronRest& rest, const SolidMaterial& material, const Vec& a,
                                  const Vec& b, const Vec& c) {
  const auto squared = [](const Vec& p) {
    return static_cast<double>(p.x) * p.x + static_cast<double>(p.y) * p.y + static_cast<double>(p.z) * p.z;
  };
  const float* w = rest.weight;
  const double stretch = -(w[0] * squared(a) + w[1] * squared(b) + w[2] * squared(c) + w[3] * squared(b - a) +
                           w[4] * squared(c - a) + w[5] * squared(c - b));
  const double volume = 1 / (6 * static_cast<double>(rest.inverse)), grown = volume_ratio(rest, a, b, c) - 1;
  const double mu = material.lame_mu, bulk = material.lame_lambda + mu;
  return 0.5 * mu * (stretch - 3 * volume) - volume * (mu * grown - 0.5 * bulk * grown * grown);
}

}  // namespace ogc::fast
