// Stage friction_force: lagged friction of one contact on one of its vertices, in the stabilised form of Vertex Block
// Descent (method.md §4.4).
#pragma once

#include "compare/stages/contact_force.hpp"

namespace ogc::compare {

/// λ = −e_k g'(d), n and the weights are those of the contact at x and count as constants in the derivatives. u = (I −
/// n nᵀ) Σ wᵢ (xᵢ − xᵢᵗ). The force is −μ λ f₁(‖u‖)/‖u‖ w u, the block μ λ f₁(‖u‖)/‖u‖ w² (I − n nᵀ); |w| Σ |w_u|
/// replaces w² as in contact_force. f₁(y) = −y²/ε² + 2y/ε for y < ε = ε_v h, 1 above; f₁(y)/y = 2/ε at y = 0.
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

/// Largest error in units of u · scale. Up to the normal (contact_force) 36; the slip (a product of vectors (3), a
/// product, a difference), its length (4), f₁/y (a quotient, a difference, a quotient), the strength (2), its products
/// with weight and slip (2): 52.
inline constexpr double friction_force_tolerance = 52;
/// Up to the strength 50; Σ |w_u| (3), its products with |w| and the strength (2), an outer product (2), the difference
/// from I (1).
inline constexpr double friction_block_tolerance = 58;

}  // namespace ogc::compare
