// Stage orientation: the unit quaternion of one segment of a rod from its ends and its neighbours' quaternions, which a
// sweep sets in one exact update (compare/rods.md).
#pragma once

#include "compare/problem/settings.hpp"
#include "compare/stages/force.hpp"
#include "compare/stages/rod.hpp"

namespace ogc::compare {

/// A neighbour of the segment across one of its ends, with its quaternion now, at the start and at rest.
struct RodNeighbour {
  float weight = 0;                   ///< w = 4 k_b/l̄ [N m]; 0: there is no neighbour, and nothing else is read
  Quaternion now{}, start{}, rest{};  ///< q_f, q_fᵗ; p° = q̄° q°_f of a neighbour ahead, q̄°_f q° of one behind [1]
};

/// Products are those of quaternions, vectors are pure ones, q̄ is the conjugate, · the product in ℝ⁴.
///
/// A neighbour pulls q to t = q_f p̄° if it lies ahead, to q_f p° if it lies behind. At the start of the step the
/// relative rotation was pᵗ = q̄ᵗ q_fᵗ ahead, q̄_fᵗ qᵗ behind, and the damping pulls q to tᵗ, the same with pᵗ for p°.
/// With D = x₁ − x₀ and c = e₃ + k R(qᵗ)ᵀ Dᵗ/l (compare/stages/rod.hpp)
///   M q = −2 k_s D q c (symmetric, M² = σ² I, σ = 2 k_s ‖D‖ ‖c‖),   b = Σ w (s t + k sᵗ tᵗ)
/// over the neighbours, where s and sᵗ, 1 or −1, are the signs that bring t and tᵗ nearer to the old q: s t·q ≥ 0.
///
/// The answer is the q that minimises −½ qᵀ M q − b·q on the unit sphere. If there are several: the old q if σ = 0 and
/// b = 0; the one nearest to the old q if b = 0; any of them if b vanishes in part (the neighbours pull to a reversed
/// director).
///
/// Legal: quaternions as in the stage rod; lengths 0 or at least 2⁻⁵⁰ m, at most 2³⁰ l; w from 2⁻⁴⁰ N m on, w (1 + k) ≤
/// 2⁶⁰ N m, so that squares are normal numbers.
struct OrientationCase {
  std::array<Vec3f, 2> vertex, start;             ///< x, xᵗ of both ends [m]
  Quaternion orientation{}, orientation_start{};  ///< the old q, which decides signs, and qᵗ [1]
  float rest_length = 0;                          ///< l [m]
  float stretch = 0;                              ///< k_s [N]
  float damping = 0;                              ///< k = k_d/h of strains [1]
  RodNeighbour behind, ahead;                     ///< neighbours across x₀ and across x₁
};

/// The question: independent cases.
struct OrientationIn {
  std::vector<OrientationCase> cases;  ///< independent of each other
};

/// The answer: the new q by case.
struct OrientationOut {
  std::vector<Quaternion> orientation;  ///< [1]
};

/// A minimiser for one choice of signs, with the function that it minimises, which gives energy and residual of other
/// quaternions.
struct OrientationAnswer {
  std::array<double, 4> orientation{};            ///< q* [1]
  std::array<std::array<double, 4>, 4> matrix{};  ///< M [N m]
  std::array<double, 4> vector{};                 ///< b [N m]
  double energy = 0;                              ///< of q* [N m]
  /// ‖∂q/∂D‖ ‖D‖ + ‖∂q/∂c‖ (1 + k ‖Dᵗ‖/l) + ‖∂q/∂k_s‖ k_s + ‖∂q/∂b‖ Σ w (1 + k), at least 1; infinite if as many units
  /// lead from one minimiser to any other: energy and residual then decide alone
  double scale = 0;
  double energy_scale = 0;  ///< 2 k_s ‖D‖ (1 + k ‖Dᵗ‖/l) + Σ w (1 + k), the unit of energy and residual [N m]
};

/// accepted[i][0] has the exact signs; there are more where a t·q is within orientation_sign_grey of 0. near[i]: a
/// sign, or the uniqueness of the minimiser, is within near_factor.
struct OrientationTruth {
  std::vector<std::vector<OrientationAnswer>> accepted;  ///< by case, the exact one first
  std::vector<std::uint8_t> near;                        ///< by case
};

/// A product of quaternions errs by 8 u of both lengths: four roundings of each component, whose moduli add up to 1 at
/// most, so 4 each, and 8 for all four. t·q: such a product, or two of them (in tᵗ), and a scalar product (4): 20.
inline constexpr double orientation_sign_grey = 20;
/// Largest error in units of u · scale, for the factor of each ∂q/∂…. b: tᵗ (16), its weight (2), sums (3): 21; the
/// part of b in each eigenspace of M: two products and half a sum (17); the answer: two quotients and a sum, its length
/// (3 + 4): 45 in all. c: a turn back and its difference, quotient, factor, sum (14 + 4), a length of qᵗ that is off
/// (8), the unit vector (4): 30. D: a difference and the unit vector (5). k_s: σ, of two lengths and three products (4
/// + 18 + 3).
inline constexpr double orientation_tolerance = 45;
/// Largest ‖(I − q qᵀ)(M q + b)‖ in units of u · energy_scale. b: 45; M: what is counted above before q enters, for D,
/// c and k_s (5 + 30 + 25), and the answer's own 7 against eigenvalues that are 2 σ apart (14).
inline constexpr double orientation_residual_tolerance = 74;
/// Largest excess over the least energy, in units of u · energy_scale: of second order where q is known; where b is
/// lost in its own error, the wrong half of the circle costs 2 · 45.
inline constexpr double orientation_energy_tolerance = 90;
/// Largest | ‖q‖ − 1 | in units of u: four squares and their sum (4) halved by the root, the root, a quotient; or a
/// factor (3 − ‖q‖²)/2 and a product.
inline constexpr double orientation_length_tolerance = 4;

}  // namespace ogc::compare
