// Stage rod: force and block of one end of one segment of a rod, damping included (compare/rods.md).
#pragma once

#include "compare/problem/settings.hpp"
#include "compare/stages/force.hpp"

namespace ogc::compare {

/// D = x₁ − x₀. A quaternion q = (u, w) rotates a vector by R(q) v = v + 2 w (u × v) + 2 u × (u × v); its director is
/// R(q) e₃.
///
/// E = k_s l/2 (‖D/l − R(q) e₃‖² + k ‖R(q)ᵀ D/l − R(qᵗ)ᵀ Dᵗ/l‖²), where q and qᵗ are given. With c = e₃ + k R(qᵗ)ᵀ Dᵗ/l
/// the force is −k_s ((1 + k) D/l − R(q) c) on x₁ and the opposite on x₀. That is the slope of E for unit quaternions
/// and, by definition, the answer for rounded ones. The block is k_s (1 + k)/l I, the exact second derivative. Force
/// and block of `own` are returned.
///
/// With `per_vertex` damping the energy is the elastic term alone. Let B be its block and moved = x − xᵗ of `own`: k B
/// moved is subtracted from the force, and the block is (1 + k) B.
///
/// Legal: quaternions of unit length within unit_quaternion_slack; lengths of 0, or from 2⁻⁵⁰ m to 2³⁰ l, now and at
/// the start.
struct RodCase {
  std::array<Vec3f, 2> vertex, start;              ///< x, xᵗ of both ends [m]
  Quaternion orientation{}, orientation_start{};   ///< q, qᵗ of the segment [1]
  float rest_length = 0;                           ///< l [m]
  float stretch = 0;                               ///< k_s [N]
  float damping = 0;                               ///< k = k_d/h [1]
  std::int32_t own = 0;                            ///< the end whose force and block are returned
  DampingForm damping_form = DampingForm::strain;  ///< the damping
};

/// Input of the stage.
struct RodIn {
  std::vector<RodCase> cases;  ///< independent of each other
};

/// Largest error of the force in units of u · scale, u = 2⁻²⁴. Let A = k_s (1 + k) ‖D‖/l, C = k_s ‖c‖ and Cᵗ = k_s k
/// ‖Dᵗ‖/l. The scale is at least A + 2 C + 3 Cᵗ, since R is quadratic in q. So the tolerance is the largest of three
/// quotients: the rounding errors of A over 1, those of C over 2 and those of Cᵗ over 3. It is 24/2 = 12.
///
/// - A: a difference, a quotient, 1 + k and its product (2), k_s, the last difference: 6.
/// - C: the rotation by R(q) (14, see below), k_s, the last difference (1 + 1), and ‖q‖², which may differ from 1 by
///   2⁻²¹ and enters other formulas for R (8): 24.
/// - Cᵗ, inside c: a difference, the rotation by R(qᵗ)ᵀ (14), a quotient, k, a sum (1 + 1 + 1 + 1) and qᵗ's length
///   (8): 26.
///
/// A rotated vector errs by at most 14 · 2⁻²⁴ of its length. With q = (u, w) the errors of R(q) v in units of 2⁻²⁴ ‖v‖
/// are:
///
/// - u × v: 2.5 ‖u‖ (a product and a difference in each component)
/// - 2 w (u × v): 7 ‖u‖ w
/// - 2 u × (u × v): 10 ‖u‖²
/// - two sums: 2 + 2 ‖u‖ w
///
/// Damping by vertex adds the term k B moved (see RodCase), whose size is added to the scale. The term has 7 rounding
/// errors: a difference (1), B (3), two products and a sum (3).
inline constexpr double rod_force_tolerance = 12;
/// Largest error of the block in units of u · scale. Rounding errors: 1 + k, a product, a quotient.
inline constexpr double rod_block_tolerance = 3;

}  // namespace ogc::compare
