// Stage spring: force and block of one end of one spring, damping included (method.md §4).
#pragma once

#include "compare/problem/settings.hpp"
#include "compare/stages/force.hpp"

namespace ogc::compare {

/// E = k_s/2 (l − l₀)² + k k_s/2 (l − lᵗ)², l = ‖x₀ − x₁‖. Asked about x₀. Block: k_s (n nᵀ + max(0, 1 − l₀/l)(I − n nᵀ)) + k k_s n nᵀ; with a rest length of 0
/// that is k_s I and the damping's part. Where l = 0 there is no direction: the force is 0, and the block is k_s I for l₀ = 0, otherwise 0.
///
/// With `per_vertex` damping the energy is the elastic term alone; with B, its block, and moved = x₀ − xᵗ₀ the force is less k B moved, and the block (1 + k) B.
///
/// Legal are lengths of 0 and from 2⁻⁶³ m on, now and at the start, whose squares are normal numbers.
struct SpringCase {
  std::array<Vec3f, 2> vertex, start;  ///< x, xᵗ [m]
  float stiffness = 0;                 ///< k_s [N/m]
  float rest_length = 0;               ///< l₀ [m]
  float damping = 0;                   ///< k = k_d/h [1]
  DampingForm damping_form = DampingForm::strain;
};

struct SpringIn {
  std::vector<SpringCase> cases;
};

/// In units of u · scale. A difference (1), a length (a square: 1 + 2 more, halved with those of the difference by the root, the root: 1; together 3), l₀/l and
/// its complement (2), k_s (1), the product with the difference (1 + 1): 9; by way of the damping a second length, its change (1), two products, a quotient, a
/// sum: 12.
inline constexpr double spring_force_tolerance = 12;
/// Complement (6), k_s and its difference (2), n by both of its factors (2 · 5), an outer product (2), two sums: 22.
inline constexpr double spring_block_tolerance = 22;

}  // namespace ogc::compare
