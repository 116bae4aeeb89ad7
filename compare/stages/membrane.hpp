// Stage membrane: force and block of one corner of one triangle, damping included (method.md §4.6, §4.9). There are two
// models: St. Venant–Kirchhoff, and stable Neo-Hookean on a membrane's 3×2 F (Smith, de Goes and Kim 2018: ψ = μ/2 (I_C
// − d) − μ (J − 1) + λ'/2 (J − 1)² with d = 2 and J the ratio of areas). With λ' = λ + μ both models have the same
// stiffness at rest.
#pragma once

#include "compare/problem/scene.hpp"
#include "compare/stages/force.hpp"

namespace ogc::compare {

/// F = Σ x_k ∇N_kᵀ = (f₁ f₂), G = (FᵀF − I)/2, ϕ(G) = λ/2 tr(G)² + μ ‖G‖². Force and block of corner 0 are returned;
/// with model `none` they are 0.
///
/// E = A (ψ + k ϕ(G − Gᵗ)). St. Venant–Kirchhoff: ψ = ϕ(G). Stable Neo-Hookean: ψ = μ/2 (‖F‖² − 2) − μ (J − 1) + (λ +
/// μ)/2 (J − 1)², J = ‖f₁ × f₂‖.
///
/// The block is the sum of the block of the damping and the block of the model:
///
/// - Damping: A k times the second derivative of ϕ, without second derivatives of G.
/// - St. Venant–Kirchhoff: A times the same, plus A max(0, ∇N₀ᵀ S ∇N₀) I with the elastic stress S.
/// - Stable Neo-Hookean: the exact second derivative, A (μ b² I + (λ + μ) g gᵀ + ((λ + μ)(J − 1) − μ) b⊥² /J n nᵀ)
///   with b = ‖∇N₀‖, t = b₁ f₂ − b₂ f₁, b⊥ = ‖t‖, g = ∂J/∂x₀ = t × n, n = f₁ × f₂/J. Only the eigenvalue along n can
///   be negative; then it is replaced by 0.
///
/// With `per_vertex` damping the energy is A ψ alone. Let B be its block and moved = x₀ − xᵗ₀: k B moved is subtracted
/// from the force, and the block is (1 + k) B.
///
/// A collapsed triangle (f₁ × f₂ = 0) has no normal: the derivatives of J count as 0, and the block is A μ b² I. Any
/// normal is accepted if f₁ × f₂ cannot be told from 0.
struct MembraneCase {
  std::array<Vec3f, 3> corner;                     ///< x [m]; a collapsed triangle is legal
  std::array<Vec3f, 3> start;                      ///< xᵗ [m]; Gᵗ is computed from it
  std::array<std::array<float, 2>, 2> gradient{};  ///< ∇N₁, ∇N₂ [1/m]; ∇N₀ = −∇N₁ − ∇N₂
  float area = 0;                                  ///< A [m²]
  float lame_lambda = 0, lame_mu = 0;              ///< [N/m]
  float damping = 0;                               ///< k = k_d/h [1]
  MembraneModel model = MembraneModel::st_venant_kirchhoff;  ///< the energy
  DampingForm damping_form = DampingForm::strain;            ///< the damping
};

/// Input of the stage.
struct MembraneIn {
  std::vector<MembraneCase> cases;  ///< independent of each other
};

/// Largest error of the force in units of u · scale, u = 2⁻²⁴. Rounding errors on the longest path from an input to the
/// force, 25 in all:
///
/// - F: a difference of corners, a product, a sum (3)
/// - G: F once more (3), a product, two sums, minus one (4); the half is exact
/// - a change of strain (1), a stress (a trace, a product, a sum: 3), the damping of the stress (a product, a sum: 2)
/// - the products of the stress with ∇N₀ (1 + 2) and with F (3 + 2), the area (1)
inline constexpr double membrane_force_tolerance = 25;
/// Largest error of the block. Rounding errors: F (3), twice; the products with ∇N₀ (1 + 2), twice; an outer product
/// (2), a factor (3), three sums.
inline constexpr double membrane_block_tolerance = 20;
/// Largest error of the force of the stable Neo-Hookean model. (The judge applies membrane_force_tolerance, so this
/// model's scales are multiplied by neo_hookean_force_tolerance/membrane_force_tolerance.) Rounding errors, 38 in all:
///
/// - (λ + μ)(J − 1) − μ, 14: J (10), and four more operations
/// - g, 20: the third edge (2), n (4 + 8 + 1), a cross product (2), the density (3)
/// - the product of (λ + μ)(J − 1) − μ and g (1), two sums (2), the area (1)
///
/// J is the length of the normal of two edges (7), times (1) the density ∇N₁ × ∇N₂ (2). The normal has 4 rounding
/// errors: two differences, a product, a difference. Its length has 2 · 4 + 3, halved by the root, and the root.
inline constexpr double neo_hookean_force_tolerance = 38;
/// Largest error of the block of the stable Neo-Hookean model. Rounding errors: (λ + μ)(J − 1) − μ (14), ‖g‖² (2 · 20 +
/// 3), its quotient by J and the sum (13), n twice (26), an outer product (2), area and sums (3): 101.
inline constexpr double neo_hookean_block_tolerance = 101;
/// Error of f₁ × f₂ in units of u · scale: 7 by the count of neo_hookean_force_tolerance, rounded up generously. If ‖f₁
/// × f₂‖ is at most twice this error, the triangle may count as collapsed, because first-order error estimates are then
/// wrong by a tenth or more.
inline constexpr double neo_hookean_grey = 16;

}  // namespace ogc::compare
