// Stage bending: force and block of one vertex of one hinge, damping included (method.md §4.7, §4.9). Two models: the
// discrete hinge, and the isometric quadratic form (Bergou et al. 2006) of a flat rest shape, k_b/2 · 3/(A₀ + A₁) ‖Σ
// K_i x_i‖² with K the sums of cotangents.
#pragma once

#include "compare/problem/scene.hpp"
#include "compare/stages/force.hpp"

namespace ogc::compare {

/// Discrete hinge: E = c/2 (θ − θ₀)² + k c/2 (θ − θᵗ)². θ in [−π, π] is the angle from the normal (x1 − x0) × (o0 − x0)
/// to the normal (o1 − x0) × (x1 − x0), positive about x1 − x0; 0 where flat. Block: c (1 + k) ∇θ ∇θᵀ. If a triangle or
/// the edge has collapsed there is no angle: force and block are 0, and θᵗ counts as 0. The normal of a nearly
/// collapsed triangle (bending_needle) is mostly rounding error: it may count as collapsed, now and at the start.
///
/// Isometric quadratic: E = c/2 ‖ℓ‖² + k c/2 (θ − θᵗ)², ℓ = Σ w_i x_i; ‖ℓ‖ is 2 sin(θ/2) as long as the triangles keep
/// their shapes. Damping needs a strain that tells one side from the other and that no rotation changes, so it is the
/// hinge's angle. Block: c w_own² I + k c ∇θ ∇θᵀ. Model `none`: force and block are 0.
///
/// With `per_vertex` damping the energy is the elastic term alone. With its block B and moved = x − xᵗ of the vertex, k
/// B moved is subtracted from the force, and the block is (1 + k) B.
struct BendingCase {
  std::array<Vec3f, 4> vertex;                        ///< x0, x1, o0, o1 [m]
  std::array<Vec3f, 4> start;                         ///< the same at the start of the step, for θᵗ
  float stiffness = 0;                                ///< c [J]
  float rest_angle = 0;                               ///< θ₀ [rad]
  float damping = 0;                                  ///< k = k_d/h [1]
  std::int32_t own = 0;                               ///< the vertex whose force and block are asked for, 0 … 3
  BendingModel model = BendingModel::discrete_hinge;  ///< the energy
  std::array<float, 3> weight{};                      ///< w of x1, o0, o1 [1/m]; w of x0 is minus their sum
  DampingForm damping_form = DampingForm::strain;     ///< the damping
};

/// The question: independent cases.
struct BendingIn {
  std::vector<BendingCase> cases;  ///< independent of each other
};

/// Largest error in units of u · scale. A difference (1), a normal (a product and a difference, twice where it is
/// squared), its square (3), the edge's length (4), a foot (4), a quotient (2), two such products and their sum (3),
/// the angle (4 u of at most π, against a scale of at least 1: 12), moment and force (4).
inline constexpr double bending_force_tolerance = 36;
/// Error of the gradient ∇θ alone, the block's other factor: all of the above but the angle, moment and force.
inline constexpr double bending_gradient = 20;
/// The gradient's error twice, a factor (2) and an outer product (2). The scale of a block also holds the square of the
/// gradient's error, bending_gradient · u · c (1 + k) · cond(∇θ)², which remains where ∇θ vanishes; the scale of a
/// force holds the product of the errors of ∇θ and the moment, 16 u · cond.
inline constexpr double bending_block_tolerance = 2 * bending_gradient + 4;
/// A hinge is grey where its angle, now or at the start, lies within this many units of u · scale of ±π: the answers
/// with 2π more or less are accepted.
inline constexpr double bending_grey = 16;
/// A triangle may count as collapsed if the sine between the edge and a side, at either end, is below this many u. The
/// normal of rounded differences has an error of 4 u; a kernel whose limit is an eighth of this changes over at 32 u,
/// give or take that error, and twice that leaves it room.
inline constexpr double bending_needle = 64;
/// Errors of the isometric quadratic model without damping; its scales are multiplied by the ratio to the tolerances
/// above. Force: a difference (1), a product (1), two sums, the weight of x0 (2), c w (1), the product (1). Block: that
/// weight twice (4), a square, c.
inline constexpr double isometric_force_tolerance = 8;
inline constexpr double isometric_block_tolerance = 6;

}  // namespace ogc::compare