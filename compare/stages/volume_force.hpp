// Stage volume_force: normal force, friction and block of one contact with a volume, on one of its vertices (§3.9;
// method.md §9).
#pragma once

#include "compare/stages/force.hpp"

namespace ogc::compare {

/// A point x₀ and the triangle (x₁, x₂, x₃) of a volume that pushes x₀ out. The detection froze the weights w₁, w₂, w₃
/// of the triangle's point c and the unit direction n. Below, w is 1 for the point and −wᵢ for corner i.
///
/// φ = n·Σ wᵢ (x₀ − xᵢ), E = k/2 max(0, r − φ)². The force is k (r − φ) w n. The block is k w² n nᵀ, the exact second
/// derivative. φ is negative inside. A contact acts while φ < r.
///
/// Friction is that of friction_force, with λ = k (r − φ): u = (I − n nᵀ)(x₀ − x₀ᵗ − Σ wᵢ (xᵢ − xᵢᵗ)), force −μ λ
/// f₁(‖u‖)/‖u‖ w u, block μ λ f₁(‖u‖)/‖u‖ w² (I − n nᵀ). The answer is the sum of normal part and friction.
///
/// Legal: weights of 0 or 2⁻⁴⁰ … 1 that add up to 1 within 2⁻²⁰; ‖n‖² within 2⁻²² of 1 (a unit vector rounded to single
/// precision is within 2⁻²³); ε_v h of at least 2⁻³⁸ m. Squares of slips below 2⁻⁶³ m are not normal numbers, but there
/// f₁(y)/y is 2/ε within 2⁻²⁵. Coordinates are arbitrary; vertices may coincide.
struct VolumeForceCase {
  std::int32_t own = 0;                ///< vertex whose force and block are returned: 0 the point, 1, 2, 3 the corners
  std::array<Vec3f, 4> vertex, start;  ///< x, xᵗ [m]: the point, then the corners of the triangle
  std::array<float, 3> weights{};      ///< w of c, by corner [1]
  std::array<float, 3> direction{};    ///< n, out of the volume [1]
  float contact_radius = 0, stiffness = 0;  ///< r [m], k [N/m]
  float friction = 0;                       ///< μ [1]
  float slip_limit = 0;                     ///< ε_v h [m]
};

/// Input of the stage.
struct VolumeForceIn {
  std::vector<VolumeForceCase> cases;  ///< independent of each other
};

/// Largest error of the force in units of u · scale, u = 2⁻²⁴: the larger of two counts of rounding errors (20.5
/// through the slip, 14 through λ), plus 4 for n, rounded up.
///
/// - Through the slip: a difference (1), its product with a weight and three sums (4), the scalar product with n (3), a
///   product, a difference: 10. The slip's length: square and sums (3, halved by the root), the root (1): 2.5.
///   f₁/‖u‖ (a quotient, a difference, a quotient): 3; μ λ and its product with f₁/‖u‖ (2); the products with weight
///   and slip (2); the sum with the normal force (1): 20.5 in all.
/// - Through λ: a difference, a product and two sums (4), the product with n (3), r − φ and k (2); then, as above, μ λ
///   and its product with f₁/‖u‖ (2), the products with weight and slip (2), the sum (1): 14.
/// - If ‖n‖² is off by 2⁻²², the slip keeps a part along n that the energy's slope lacks: 4.
inline constexpr double volume_force_tolerance = 25;
/// Largest error of the block. Rounding errors: μ λ f₁/‖u‖ (17.5, see volume_force_tolerance), w² and its product (2),
/// an outer product (2), the difference from I (1), the sum with the normal block (1): 23.5, rounded up.
inline constexpr double volume_block_tolerance = 24;
/// Largest error of r − φ in units of u · scale: 8 rounding errors (a difference, a product and two sums: 4; the
/// product with n: 3; r − φ), and 4 more for other orders of evaluation. If |r − φ| is at most this error, the contact
/// may act or not.
inline constexpr double volume_force_grey = 12;

}  // namespace ogc::compare
