// Stage friction_force: lagged friction of one contact on one of its vertices, stabilised as in Vertex Block Descent
// (method.md §4.4).
#pragma once

#include "compare/stages/contact_force.hpp"

namespace ogc::compare {

/// λ = −e_k g'(d), n and the weights are those of the contact at x and count as constants in the derivatives. With u =
/// (I − n nᵀ) Σ wᵢ (xᵢ − xᵢᵗ) the force is −μ λ f₁(‖u‖)/‖u‖ w u, and the block is μ λ f₁(‖u‖)/‖u‖ w² (I − n nᵀ). As in
/// contact_force, |w| Σ |w_u| replaces w² if other vertices are updated together with the vertex. f₁(y) = −y²/ε² + 2y/ε
/// for y < ε = ε_v h, 1 above; f₁(y)/y = 2/ε at y = 0.
struct FrictionForceCase {
  ContactForceCase contact;    ///< the contact; its normal force is λ
  std::array<Vec3f, 4> start;  ///< xᵗ [m]
  float friction = 0;          ///< μ [1]
  float slip_limit = 0;        ///< ε_v h [m]
};

/// Input of the stage.
struct FrictionForceIn {
  std::vector<FrictionForceCase> cases;  ///< independent of each other
};

/// Largest error of the force in units of u · scale, u = 2⁻²⁴. Rounding errors: n (36, see contact_force), the slip u
/// (a scalar product (3), a product, a difference), the slip's length (4), f₁/‖u‖ (a quotient, a difference, a
/// quotient), the products of f₁/‖u‖ with λ and μ (2), then with weight and slip (2): 52.
inline constexpr double friction_force_tolerance = 52;
/// Largest error of the block. Rounding errors: μ λ f₁/‖u‖ (50, see friction_force_tolerance), Σ |w_u| (3), the
/// products with |w| and μ λ f₁/‖u‖ (2), an outer product (2), the difference from I (1).
inline constexpr double friction_block_tolerance = 58;

}  // namespace ogc::compare
