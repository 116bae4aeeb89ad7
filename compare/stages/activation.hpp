// Stage activation: contact energy over distance, its slope and curvature (Eq. 18–20; Eq. 19 corrected, method.md
// §1.1), and the other activations (method.md §4.2).
#pragma once

#include <vector>

#include "compare/problem/settings.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// n cases. r [m] and k_c [N/m] are within 2⁻²⁰ … 2²⁰. The distance d [m] is within min(2⁻²⁰, 2⁻⁴⁰ r) … 2²⁰.
struct ActivationIn {
  std::vector<float> distance, contact_radius, stiffness;  ///< by case: d [m], r [m], k_c [N/m]
  std::vector<ContactActivation> activation;               ///< by case
};

/// g [J], g' [N], g'' [N/m]; 0 for d ≥ r. At d = τ = r/2 the quadratic branch holds.
///
/// - `ogc`: k_c/2 (r − d)² for d ≥ τ; below τ, k' (ln τ − ln d) + k_c/2 (r − τ)² with k' = τ k_c (r − τ)
/// - `ogc_as_printed`: as `ogc`, but k' = τ k_c (τ − r)² with lengths in metres, so that g' jumps at τ
/// - `quadratic`: k_c/2 (r − d)²
/// - `ipc_log`: −k_c (d − r)² ln(d/r)
/// - `cubic`: 2 k_c/(3r) (r − d)³
struct ActivationOut {
  std::vector<float> energy, slope, curvature;  ///< by case: g [J], g' [N], g'' [N/m]
};

/// Values computed with multiprecision and rounded to double, and their error scales. A scale is the sum of the moduli
/// of the terms of the value. It is at least 2⁻¹⁰² for d < r, so that u · scale covers an underflow near r (2⁻¹²⁶).
struct ActivationTruth {
  std::vector<double> energy, slope, curvature;                    ///< by case: g [J], g' [N], g'' [N/m]
  std::vector<double> energy_scale, slope_scale, curvature_scale;  ///< error scales
};

/// Largest error in units of u · scale, u = 2⁻²⁴. Rounding errors of each activation:
///
/// - Quadratic branch: two factors r − d (2), their products with k_c/2 (2): 4.
/// - Logarithmic branch: r − τ (1), k' (2), ln(τ/d) (6.5, see `ipc_log`), product and sum (2): 11.5.
/// - `cubic`: 2k_c/(3r) (2), three factors r − d (3), their products (3): 8.
/// - `ipc_log`, where ln(r/d) has 6.5 at most. Up to r = 2 d it is a series (2) in (r − d)/(r + d) (3): 5. Beyond, r/d
///   (1 of the quotient, 1.5 of ln(r/d) ≥ ln 2) is a power of two times m, and the series (2) in (m − 1)/(m + 1), where
///   m − 1 is exact (2), is added to the power's logarithm (1): 6.5.
///   g: two factors r − d (2), ln(r/d) (6.5), products (3): 11.5.
///   g' = −k_c (r − d) (2 ln(r/d) + s), s = (r − d)/d: ln(r/d) (6.5), the sum (1), r − d (1), products (2): 10.5.
///   g'' = k_c (2 ln(r/d) + s (4 + s)): ln(r/d) (6.5), the sum (1), product with k_c (1): 8.5; through s: twice (4),
///   4 + s (1), their product (1), the sum (1), product with k_c (1): 8.
///
/// The largest count is rounded up.
inline constexpr double activation_tolerance = 12;

}  // namespace ogc::compare
