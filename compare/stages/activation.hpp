// Stage activation: contact energy over distance, slope and curvature (Eq. 18–20; Eq. 19 corrected, method.md §1).
#pragma once

#include <vector>

#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// n cases: distance d > 0 [m], contact radius r [m], stiffness k_c [N/m].
struct ActivationIn {
  std::vector<float> distance, contact_radius, stiffness;
};

/// g [J], g' [N], g'' [N/m]; 0 for d ≥ r. At d = τ = r/2 the quadratic stage holds.
struct ActivationOut {
  std::vector<float> energy, slope, curvature;
};

/// Values in double from multiprecision, and the sum of the moduli of the terms of which each consists: the unit of the errors.
struct ActivationTruth {
  std::vector<double> energy, slope, curvature;
  std::vector<double> energy_scale, slope_scale, curvature_scale;
};

/// Largest error in units of u · scale. Quadratic stage: r − d (1), square (2), k_c/2 (1). Logarithmic stage: r − τ (1), k'_c (2), log (library: 2 ulp,
/// design.md allows 1 between backends), product and sum (2), b (4).
inline constexpr double activation_tolerance = 12;

}  // namespace ogc::compare
