// Stage rod: force and block of one end of one segment of a rod, damping included (compare/rods.md).
#pragma once

#include "compare/problem/settings.hpp"
#include "compare/stages/force.hpp"

namespace ogc::compare {

/// D = x₁ − x₀; a quaternion q = (u, w) turns by R(q) v = v + 2 w (u × v) + 2 u × (u × v), and its director is R(q) e₃.
///
/// E = k_s l/2 (‖D/l − R(q) e₃‖² + k ‖R(q)ᵀ D/l − R(qᵗ)ᵀ Dᵗ/l‖²), where q and qᵗ are given. With c = e₃ + k R(qᵗ)ᵀ
/// Dᵗ/l: force −k_s ((1 + k) D/l − R(q) c) on x₁ and the opposite on x₀, the slope of E for unit quaternions and, by
/// definition, the answer for rounded ones; block k_s (1 + k)/l I, the exact second derivative. The question is about
/// `own`.
///
/// With `per_vertex` damping the energy is the elastic term alone. With its block B and moved = x − xᵗ of `own`, k B
/// moved is subtracted from the force, and the block is (1 + k) B.
///
/// Legal: quaternions are of unit length within unit_quaternion_slack; lengths are 0 or at least 2⁻⁵⁰ m, now and at the
/// start, and at most 2³⁰ l.
struct RodCase {
  std::array<Vec3f, 2> vertex, start;              ///< x, xᵗ of both ends [m]
  Quaternion orientation{}, orientation_start{};   ///< q, qᵗ of the segment [1]
  float rest_length = 0;                           ///< l [m]
  float stretch = 0;                               ///< k_s [N]
  float damping = 0;                               ///< k = k_d/h [1]
  std::int32_t own = 0;                            ///< the end whose force and block are asked for
  DampingForm damping_form = DampingForm::strain;  ///< the damping
};

/// The question: independent cases.
struct RodIn {
  std::vector<RodCase> cases;  ///< independent of each other
};

/// Largest error in units of u · scale. With A = k_s (1 + k) ‖D‖/l, C = k_s ‖c‖ and Cᵗ = k_s k ‖Dᵗ‖/l the scale is at
/// least A + 2 C + 3 Cᵗ, since R is quadratic in q. A turned vector errs by at most 14 u of its length: u × v by 2.5 of
/// ‖u‖ ‖v‖ (a product and a difference in each component), doubled, times w (7 with a product), crossed once more (10),
/// two sums; the largest of 7 ‖u‖ w + 10 ‖u‖² + 2 + 2 ‖u‖ w. Of A: a difference, a quotient, 1 + k and its product (2),
/// k_s, the last difference: 6. Of C: the turn (14), k_s, the last difference (1 + 1), and ‖q‖² that is off by 2⁻²¹,
/// which shows in other forms of R (8): 24 against 2 C. Of Cᵗ, inside c: a difference, the turn back (14), a quotient,
/// k, a sum (1 + 1 + 1 + 1) and qᵗ's length (8): 26 against 3 Cᵗ. So 12; with damping by vertex a difference, a block
/// of 3, two products and a sum stand against `moved`, which adds its size once more: 7.
inline constexpr double rod_force_tolerance = 12;
/// 1 + k, a product, a quotient.
inline constexpr double rod_block_tolerance = 3;

}  // namespace ogc::compare
