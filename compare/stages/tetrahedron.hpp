// Stage tetrahedron: force and block of one corner of one tetrahedron, damping included (method.md §4.9, §8). The model
// is stable Neo-Hookean (Smith, de Goes and Kim 2018, without the logarithm).
#pragma once

#include "compare/problem/settings.hpp"
#include "compare/stages/force.hpp"

namespace ogc::compare {

/// F = Σ x_k ∇N_kᵀ, J = det F, G = (FᵀF − I)/2, ϕ(G) = λ/2 tr(G)² + μ ‖G‖². Force and block of corner 0 are returned.
/// The other corners are ordered so that det(x₁ − x₀, x₂ − x₀, x₃ − x₀) > 0 at rest. Inverted and flat tetrahedra and
/// coinciding corners are legal.
///
/// E = V [μ/2 (‖F‖² − 3) − μ (J − 1) + (λ + μ)/2 (J − 1)² + k ϕ(G − Gᵗ)]. Each number of the rest shape is rounded
/// once. w_k = V ∇N_k·∇N₀ and i = 1/(6V) define the elastic part:
///   V ‖F‖²/2 = −½ Σ_k w_k ‖x_k − x₀‖² + terms without x₀,   J = i det(x₁ − x₀, x₂ − x₀, x₃ − x₀),   V = 1/(6i).
/// The damping computes F from ∇N₁, ∇N₂, ∇N₃, with ∇N₀ = −∇N₁ − ∇N₂ − ∇N₃.
///
/// Block of the elastic part: the exact second derivative V (μ ‖∇N₀‖² I + (λ + μ) g gᵀ) with g = ∂J/∂x₀. J is affine in
/// one vertex, so no term is dropped or clamped. Block of the damping: V k times the second derivative of ϕ, without
/// second derivatives of G: V k ((λ + μ)(F∇N₀)(F∇N₀)ᵀ + μ ‖∇N₀‖² F Fᵀ).
///
/// With `per_vertex` damping the energy is the elastic part alone. Let B be its block and moved = x₀ − xᵗ₀: k B moved
/// is subtracted from the force, and the block is (1 + k) B.
///
/// Lengths are 0 or at least 2⁻³⁰ m. |w_k| ≤ 2⁶⁰ m, 2⁻⁷⁰ ≤ i ≤ 2⁸⁰ /m³, as validation of a scene guarantees. Σ w_k < 0,
/// as for any shape with volume. So that products do not overflow, i L³ ≤ 2³⁰, where L is the longest length now and at
/// the start; with damping of strain no component of a gradient times L is above 2²⁰.
struct TetrahedronCase {
  std::array<Vec3f, 4> corner;                     ///< x [m]
  std::array<Vec3f, 4> start;                      ///< xᵗ [m]; Gᵗ is computed from it
  std::array<float, 3> weight{};                   ///< w_k of corners 1, 2, 3 [m]
  float inverse = 0;                               ///< i = 1/(6V) [1/m³]
  std::array<std::array<float, 3>, 3> gradient{};  ///< ∇N₁, ∇N₂, ∇N₃ [1/m]; read only for damping of strain
  float volume = 0;                                ///< V of the damping [m³]; read only for damping of strain
  float lame_lambda = 0, lame_mu = 0;              ///< [Pa]
  float damping = 0;                               ///< k = k_d/h [1]
  DampingForm damping_form = DampingForm::strain;  ///< the damping
};

/// Input of the stage.
struct TetrahedronIn {
  std::vector<TetrahedronCase> cases;  ///< independent of each other
};

/// Largest error of the elastic force in units of u · scale, u = 2⁻²⁴. Rounding errors on the longest path from an
/// input to the force, 25 in all:
///
/// - a difference of corners (1); a normal of two edges: another difference, twice (4), a product and a difference
///   (2)
/// - J: a difference, a product, two sums, the factor i (5)
/// - the factor of the normal: J minus one (1), λ + μ (2), minus μ (1)
/// - the normal once more (6), its product and the sixth (2), the sum (1)
///
/// The two edges of the normal are rounded separately, so the normal's scale also contains their lengths. This matters
/// for a far corner and two near ones.
inline constexpr double tetrahedron_force_tolerance = 25;
/// Largest error of the elastic block. Rounding errors: the normal twice (12), an outer product (2), (λ + μ) i/6 (3), Σ
/// w_k and the product with it (1 + 1 + 1), the sum (1): 21.
inline constexpr double tetrahedron_block_tolerance = 21;
/// Largest error of the damping's force. (The judge applies tetrahedron_force_tolerance, so the damping's scales are
/// multiplied by the ratio of this tolerance to tetrahedron_force_tolerance.) Rounding errors, 32 in all:
///
/// - F: a difference, a product, two sums (4)
/// - G: F once more (4), a product, two sums, minus one (4); the half is exact
/// - a change of strain (1), a stress through its trace (two sums, a product, a sum: 4)
/// - the products of the stress with ∇N₀ (2 + 3) and with F (4 + 3), V k and its product (2), the sum (1)
inline constexpr double tetrahedron_damping_force_tolerance = 32;
/// Largest error of the damping's block. Rounding errors: F∇N₀ (4 + 2 + 3), twice, an outer product (2), V k (λ + μ)
/// (4), sums (3): 27.
inline constexpr double tetrahedron_damping_block_tolerance = 27;

}  // namespace ogc::compare
