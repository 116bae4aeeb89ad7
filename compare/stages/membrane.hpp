// Stage membrane: St. Venant–Kirchhoff force and block of one corner of one triangle, damping included (method.md §4, scenes.md).
#pragma once

#include "compare/stages/force.hpp"

namespace ogc::compare {

/// E = A (ψ(G) + k ψ(G − Gᵗ)), ψ(G) = λ/2 tr(G)² + μ ‖G‖², G = (FᵀF − I)/2, F = Σ x_k ∇N_kᵀ. Asked about corner 0.
/// Block: A (1 + k) times the second derivative of ψ along the derivatives of G, plus A max(0, ∇N₀ᵀ S ∇N₀) I with the elastic stress S.
struct MembraneCase {
  std::array<Vec3f, 3> corner;                    ///< x [m]; a collapsed triangle is legal
  std::array<Vec3f, 3> start;                     ///< xᵗ [m], of Gᵗ
  std::array<std::array<float, 2>, 2> gradient{};  ///< ∇N₁, ∇N₂ [1/m]; ∇N₀ = −∇N₁ − ∇N₂
  float area = 0;                                 ///< A [m²]
  float lame_lambda = 0, lame_mu = 0;             ///< [N/m]
  float damping = 0;                              ///< k = k_d/h [1]
};

struct MembraneIn {
  std::vector<MembraneCase> cases;
};

/// In units of u · scale. On the longest way from an input to the force lie a difference (1), F (a product and a sum), G (a product, two sums, minus one; F
/// enters twice: 3 more), a change of strain (1), a stress (a trace, a product, a sum), its damping (2), its product with ∇N₀ (1 + 2) and with F (2 + 3), the area (1): 24.
inline constexpr double membrane_force_tolerance = 24;
/// F (3), twice; with ∇N₀ (1 + 2), twice; an outer product (2), a weight (3), three sums.
inline constexpr double membrane_block_tolerance = 20;

}  // namespace ogc::compare
