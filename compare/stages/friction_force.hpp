// Stage friction_force: lagged friction of one contact on one of its vertices, in the stabilised form of Vertex Block Descent (method.md §4).
#pragma once

#include "compare/stages/contact_force.hpp"

namespace ogc::compare {

/// λ = −e_k g'(d), n and the weights are those of the contact at x and constant in the derivatives. u = (I − n nᵀ) Σ wᵢ (xᵢ − xᵢᵗ). Force
/// −μ λ f₁(‖u‖)/‖u‖ w u, block μ λ f₁(‖u‖)/‖u‖ w² (I − n nᵀ), with f₁(y) = −y²/ε² + 2y/ε for y < ε = ε_v h, 1 above; f₁(y)/y = 2/ε at y = 0.
struct FrictionForceCase {
  ContactForceCase contact;
  std::array<Vec3f, 4> start;  ///< xᵗ [m]
  float friction = 0;          ///< μ [1]
  float slip_limit = 0;        ///< ε_v h [m]
};

struct FrictionForceIn {
  std::vector<FrictionForceCase> cases;
};

}  // namespace ogc::compare
