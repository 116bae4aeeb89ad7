// Stage bending: force and block of one vertex of one hinge, damping included (method.md §4.7, §4.9). There are two
// models: the discrete hinge, and the isometric quadratic form (Bergou et al. 2006) of a flat rest shape, k_b/2 · 3/(A₀
// + A₁) ‖Σ K_i x_i‖² with K the sums of cotangents.
#pragma once

#include "compare/problem/scene.hpp"
#include "compare/stages/force.hpp"

namespace ogc::compare {

/// Discrete hinge: E = c/2 (θ − θ₀)² + k c/2 (θ − θᵗ)². θ in [−π, π] is the angle from the normal (x1 − x0) × (o0 − x0)
/// to the normal (o1 − x0) × (x1 − x0), positive about x1 − x0; 0 if flat. Block: c (1 + k) ∇θ ∇θᵀ. A collapsed
/// triangle or edge has no angle: force and block are 0, and θᵗ counts as 0. The normal of a nearly collapsed triangle
/// (bending_needle) is mostly rounding error, so the triangle may count as collapsed, now and at the start.
///
/// Isometric quadratic: E = c/2 ‖ℓ‖² + k c/2 (θ − θᵗ)², ℓ = Σ w_i x_i; ‖ℓ‖ is 2 sin(θ/2) if the triangles keep their
/// shapes. The damping uses the hinge's angle, since ‖ℓ‖ is the same for θ and −θ. Block: c w_own² I + k c ∇θ ∇θᵀ.
/// Model `none`: force and block are 0.
///
/// With `per_vertex` damping the energy is the elastic term alone. Let B be its block and moved = x − xᵗ of the vertex:
/// k B moved is subtracted from the force, and the block is (1 + k) B.
struct BendingCase {
  std::array<Vec3f, 4> vertex;                        ///< x0, x1, o0, o1 [m]
  std::array<Vec3f, 4> start;                         ///< x at the start of the step, for θᵗ [m]
  float stiffness = 0;                                ///< c [J]
  float rest_angle = 0;                               ///< θ₀ [rad]
  float damping = 0;                                  ///< k = k_d/h [1]
  std::int32_t own = 0;                               ///< the vertex whose force and block are returned, 0 … 3
  BendingModel model = BendingModel::discrete_hinge;  ///< the energy
  std::array<float, 3> weight{};                      ///< w of x1, o0, o1 [1/m]; w of x0 is minus their sum
  DampingForm damping_form = DampingForm::strain;     ///< the damping
};

/// Input of the stage.
struct BendingIn {
  std::vector<BendingCase> cases;  ///< independent of each other
};

/// Largest error of the force in units of u · scale, u = 2⁻²⁴. Rounding errors, 36 in all:
///
/// - ∇θ, 20: a difference of vertices (1), the normal and its square (6), the edge's length (4), a closest point on
///   the edge (4), a quotient (2), two products of these and their sum (3)
/// - θ, 12: 4 u of |θ| ≤ π, while the scale is at least 1
/// - the moment and the force, 4
inline constexpr double bending_force_tolerance = 36;
/// Largest error of the gradient ∇θ in units of u · scale; bending_force_tolerance counts its rounding errors.
inline constexpr double bending_gradient = 20;
/// Largest error of the block in units of u · scale. Rounding errors: ∇θ twice, a factor (2), an outer product (2).
///
/// Scales also contain terms of second order, which remain where a first derivative vanishes. Let cond(f) be Σ ‖∂f/∂q‖
/// ‖q‖ over the inputs q.
///
/// - The block's scale contains bending_gradient · u · c (1 + k) · cond(∇θ)².
/// - The force's scale contains the product of the error of ∇θ, bending_gradient · u · cond(∇θ), and the error of
///   the moment ∂E/∂θ, 16 u · cond(∂E/∂θ).
inline constexpr double bending_block_tolerance = 2 * bending_gradient + 4;
/// A hinge is grey if its angle, now or at the start, is within this many units of u · scale of ±π. Then the answers
/// for the angle plus and minus 2π are accepted as well.
inline constexpr double bending_grey = 16;
/// A triangle may count as collapsed if, at either end of the hinge's edge, the sine of the angle between this edge and
/// the triangle's other edge is below bending_needle · u. The normal of rounded differences has an error of 4 u. A
/// kernel may treat sines below 32 u, eight times this error, as 0. Twice 32 u also covers the rounding of the kernel's
/// test.
inline constexpr double bending_needle = 64;
/// Largest errors of the isometric quadratic model without damping, in units of u · scale. (The judge applies
/// bending_force_tolerance and bending_block_tolerance. So this model's force scale is multiplied by
/// isometric_force_tolerance/bending_force_tolerance, and its block scale by the ratio for the block.) Rounding errors,
/// with the symbols of BendingCase:
///
/// - force: a difference (1), a product (1), two sums (2), the weight of x0 (2), c w (1), the product of c w and ℓ
///   (1)
/// - block: the weight of x0 twice (4), a square (1), c (1)
inline constexpr double isometric_force_tolerance = 8;
inline constexpr double isometric_block_tolerance = 6;

}  // namespace ogc::compare