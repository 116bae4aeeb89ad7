// Stage orientation: the unit quaternion of one segment of a rod, computed from its ends and its neighbours'
// quaternions. A sweep sets it in one exact update (compare/rods.md).
#pragma once

#include "compare/problem/settings.hpp"
#include "compare/stages/force.hpp"
#include "compare/stages/rod.hpp"

namespace ogc::compare {

/// A neighbour of the segment across one of its ends, with its quaternion now, at the start and at rest.
struct RodNeighbour {
  float weight = 0;                   ///< weight w = 4 k_b/l̄ [N m]; 0 means no neighbour, and nothing else is read
  Quaternion now{}, start{}, rest{};  ///< q_f, q_fᵗ; p° = q̄° q°_f of a neighbour ahead, q̄°_f q° of one behind [1]
};

/// Products are quaternion products, vectors count as pure quaternions, q̄ is the conjugate, · the product in ℝ⁴.
///
/// A neighbour ahead pulls q to t = q_f p̄°, a neighbour behind to t = q_f p°. The relative rotation at the start of
/// the step was pᵗ = q̄ᵗ q_fᵗ ahead, q̄_fᵗ qᵗ behind. The damping pulls q to tᵗ, which is t with pᵗ in place of p°.
/// With D = x₁ − x₀ and c = e₃ + k R(qᵗ)ᵀ Dᵗ/l (compare/stages/rod.hpp)
///   M q = −2 k_s D q c (symmetric, M² = σ² I, σ = 2 k_s ‖D‖ ‖c‖),   b = Σ w (s t + k sᵗ tᵗ)
/// over the neighbours. The signs s and sᵗ, 1 or −1, bring t and tᵗ nearer to the old q: s t·q ≥ 0, sᵗ tᵗ·q ≥ 0.
///
/// The answer is the q that minimises −½ qᵀ M q − b·q on the unit sphere. If there are several minimisers, the answer
/// is
///
/// - the old q if σ = 0 and b = 0,
/// - the minimiser nearest to the old q if b = 0 and σ ≠ 0,
/// - any minimiser if only a component of b vanishes (the neighbours pull to a reversed director).
///
/// Legal: quaternions as in stage rod; lengths 0 or at least 2⁻⁵⁰ m, at most 2³⁰ l; w ≥ 2⁻⁴⁰ N m and w (1 + k) ≤ 2⁶⁰ N
/// m, so that squares are normal numbers.
struct OrientationCase {
  std::array<Vec3f, 2> vertex, start;             ///< x, xᵗ of both ends [m]
  Quaternion orientation{}, orientation_start{};  ///< the old q, which decides signs, and qᵗ [1]
  float rest_length = 0;                          ///< l [m]
  float stretch = 0;                              ///< k_s [N]
  float damping = 0;                              ///< k = k_d/h of strains [1]
  RodNeighbour behind, ahead;                     ///< neighbours across x₀ and across x₁
};

/// Input of the stage.
struct OrientationIn {
  std::vector<OrientationCase> cases;  ///< independent of each other
};

/// The answer: the new q by case.
struct OrientationOut {
  std::vector<Quaternion> orientation;  ///< [1]
};

/// A minimiser for one choice of signs, with the function that it minimises. The function gives energy and residual of
/// other quaternions.
struct OrientationAnswer {
  std::array<double, 4> orientation{};            ///< q* [1]
  std::array<std::array<double, 4>, 4> matrix{};  ///< M [N m]
  std::array<double, 4> vector{};                 ///< b [N m]
  double energy = 0;                              ///< of q* [N m]
  /// Error scale of q*: ‖∂q/∂D‖ ‖D‖ + ‖∂q/∂c‖ (1 + k ‖Dᵗ‖/l) + ‖∂q/∂k_s‖ k_s + ‖∂q/∂b‖ Σ w (1 + k), at least 1. It is
  /// infinite if errors within the tolerance can change one minimiser into any other; then only energy and residual are
  /// judged
  double scale = 0;
  double energy_scale = 0;  ///< 2 k_s ‖D‖ (1 + k ‖Dᵗ‖/l) + Σ w (1 + k), error scale of energy and residual [N m]
};

/// accepted[i][0] is the answer of case i for the exact signs. Other signs are accepted as well if t·q or tᵗ·q is
/// within orientation_sign_grey of 0. near[i] is 1 if a sign, or the uniqueness of the minimiser, is within
/// near_factor.
struct OrientationTruth {
  std::vector<std::vector<OrientationAnswer>> accepted;  ///< by case, the exact one first
  std::vector<std::uint8_t> near;                        ///< by case
};

/// Largest error of t·q and tᵗ·q in units of u = 2⁻²⁴. A product of two unit quaternions errs by 8 u: each of its four
/// components is a sum of terms whose moduli add up to at most 1, with 4 rounding errors. t is one product, tᵗ two of
/// them (16). The scalar product adds 4: 20.
inline constexpr double orientation_sign_grey = 20;
/// Largest error in units of u · scale. Each term of OrientationAnswer::scale has its own count of rounding errors; the
/// largest decides:
///
/// - b, 45: tᵗ (16), the weight (2), sums (3); the component of b in each eigenspace of M (two products and half a
///   sum: 17); the answer (two quotients and a sum: 3, its length: 4).
/// - c, 30: the difference Dᵗ rotated by R(qᵗ)ᵀ, a quotient, a factor, a sum (14 + 4); a qᵗ that is not quite of
///   unit length (8); the unit vector (4).
/// - D: a difference and the unit vector (5).
/// - k_s, 25: σ, made of two lengths and three products (4 + 18 + 3).
inline constexpr double orientation_tolerance = 45;
/// Largest residual ‖(I − q qᵀ)(M q + b)‖ in units of u · energy_scale: the larger of two counts of rounding errors.
///
/// - b: 45, see orientation_tolerance.
/// - M q, 74: D (5), c (30) and k_s (25) as in orientation_tolerance; the error of the answer q (7) times 2 σ, the
///   distance of M's eigenvalues (14).
inline constexpr double orientation_residual_tolerance = 74;
/// Largest energy above the least energy, in units of u · energy_scale. If q is well determined, the difference is of
/// second order. If b is smaller than its own error, q may lie on the wrong half of the circle of minimisers. The
/// difference is then at most twice the error of b (45).
inline constexpr double orientation_energy_tolerance = 90;
/// Largest | ‖q‖ − 1 | in units of u. Rounding errors: four squares and their sum (4, halved by the root: 2), the root
/// (1), a quotient (1). Normalisation by a product with (3 − ‖q‖²)/2 has no larger error.
inline constexpr double orientation_length_tolerance = 4;

}  // namespace ogc::compare
