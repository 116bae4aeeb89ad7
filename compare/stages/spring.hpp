// Stage spring: force and block of one end of one spring, damping included (method.md §4.8, §4.9).
#pragma once

#include "compare/problem/settings.hpp"
#include "compare/stages/force.hpp"

namespace ogc::compare {

/// E = k_s/2 (l − l₀)² + k k_s/2 (l − lᵗ)², l = ‖Σ wᵢ xᵢ‖, w = (1, s − 1, −s). A stitch, s > 0, joins a vertex and a
/// point between two others. A spring, s = 0, joins two vertices; then x₂ is not read. Force and block of `own` are
/// returned. Block: w² (k_s (n nᵀ + max(0, 1 − l₀/l)(I − n nᵀ)) + k k_s n nᵀ), with the w of `own`. With a rest length
/// of 0 that is w² k_s I plus the damping's part. At l = 0 there is no direction: the force is 0, and the block is w²
/// k_s I for every l₀, which majorises E since −k_s l₀ l ≤ 0.
///
/// With `per_vertex` damping the energy is the elastic term alone. Let B be its block and moved = x − xᵗ of `own`: k B
/// moved is subtracted from the force, and the block is (1 + k) B.
///
/// Legal lengths, now and at the start, are 0 and from 2⁻⁶³ m on, whose squares are normal numbers.
struct SpringCase {
  std::array<Vec3f, 3> vertex, start;              ///< x, xᵗ [m]
  float stiffness = 0;                             ///< k_s [N/m]
  float rest_length = 0;                           ///< l₀ [m]
  float damping = 0;                               ///< k = k_d/h [1]
  float ratio = 0;                                 ///< s [1], from 0 to 1
  std::int32_t own = 0;                            ///< the vertex whose force and block are returned; 2 only if s > 0
  DampingForm damping_form = DampingForm::strain;  ///< the damping
};

/// Input of the stage.
struct SpringIn {
  std::vector<SpringCase> cases;  ///< independent of each other
};

/// Largest error of a spring's force in units of u · scale, u = 2⁻²⁴. Rounding errors:
///
/// - without damping, 9: a difference of vertices (1), its length (3: a square with sums and difference, 1 + 2 + 2 ·
///   1, halved by the root, and the root), l₀/l and 1 − l₀/l (2), k_s (1), the product with the vector (1 + 1)
/// - with damping, 12: also the second length, the change of length, two products, a quotient, a sum
inline constexpr double spring_force_tolerance = 12;
/// Largest error of a spring's block. Rounding errors: 1 − l₀/l (6), one minus it and the product with k_s (2), both
/// factors n (2 · 5), an outer product (2), two sums: 22.
inline constexpr double spring_block_tolerance = 22;

/// Largest error of a stitch's force. The count of a spring, 12, grows to 25:
///
/// - The vector between the ends errs by 4 instead of 1 (two differences, the product with s, their difference): 3
///   more.
/// - Each of two lengths errs by 7 instead of 3 (a square with 8 + 3 errors, halved by the root; the root): 8 more.
/// - w and the product with w: 2 more.
inline constexpr double stitch_force_tolerance = 25;
/// Largest error of a stitch's block. Rounding errors: 1 − l₀/l (6 + 4), one minus it and the product with k_s (2),
/// both factors n (2 · (4 + 7 + 1)), an outer product (2), two sums, w² (3) and its product: 44.
inline constexpr double stitch_block_tolerance = 44;

}  // namespace ogc::compare
