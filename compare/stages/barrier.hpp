// Stage barrier: IPC's barrier over the squared distance, its slope and its curvature (Li et al. 2020, Eq. 6; with a
// thickness Li et al. 2021, Eq. 10). Plug-ins may implement it; the fast path does not.
#pragma once

#include <vector>

#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// D, d̂ and ξ of one case. With g = D − ξ² and H = d̂ (d̂ + 2 ξ) a case is legal if
///
/// - d̂ is within 2⁻²⁰ … 2²⁰,
/// - ξ is 0, or within 2⁻²⁰ … 2²⁰ and at most 2¹⁰ d̂,
/// - D ≤ 2⁴², g ≥ 2⁻⁴⁰ H, and g ≥ 2⁻¹⁸ D, a gap that single precision can tell from 0.
struct BarrierCase {
  float squared_distance = 0;     ///< D [m²]
  float activation_distance = 0;  ///< d̂ [m]
  float thickness = 0;            ///< ξ [m]
};

/// Input of the stage.
struct BarrierIn {
  std::vector<BarrierCase> cases;  ///< independent of each other
};

/// b = −(g − H)² ln(g/H), db/dD and d²b/dD²; 0 for g ≥ H.
struct BarrierOut {
  std::vector<float> energy, slope, curvature;  ///< by case [m⁴], [m²], [1]
};

/// Values f in double precision and their error scales. A scale is the sum of |∂f/∂D| D, |∂f/∂ξ²| ξ², |∂f/∂H| H and the
/// moduli of the terms of f. It is at least 2⁻¹⁰² for g < H, as in stage activation.
struct BarrierTruth {
  std::vector<double> energy, slope, curvature;                    ///< by case
  std::vector<double> energy_scale, slope_scale, curvature_scale;  ///< error scales
};

/// Largest error in units of u · scale, u = 2⁻²⁴. Each term of the scale has its own count of rounding errors. The
/// tolerance is the largest count (9), plus 1 for second order:
///
/// - D and ξ²: square and difference (2), the quotient g/H (1).
/// - H: sum and product (2), the difference H − g (1).
/// - Terms: the difference g − H, twice (2), its square (1), the logarithm (4), product and sum (2): 9.
inline constexpr double barrier_tolerance = 10;

}  // namespace ogc::compare
