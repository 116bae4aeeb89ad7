// Computes the stage activation: Eq. 18–20 with Eq. 19 corrected (method.md §1.1), and the variants of the ablation
// (method.md §4.2).
#pragma once

#include "compare/stages/activation.hpp"

namespace ogc::reference {

/// Computes energy, slope and curvature of all cases in multiprecision. The scale of a value is the sum of the moduli
/// of its terms. The two-stage energy has the terms of Eq. 18 and 20 as printed, with logarithms of metres. Value and
/// scale are zero for d ≥ r.
compare::ActivationTruth activation(const compare::ActivationIn& in);

/// The activation and its derivatives by d at one distance, rounded from multiprecision.
struct ActivationValue {
  double energy = 0, slope = 0, curvature = 0;  ///< g [J], g' [N], g'' [N/m]
  /// error scales, as in compare::ActivationTruth
  double energy_scale = 0, slope_scale = 0, curvature_scale = 0;
};
/// Returns the activation at the distance d ≥ 0 [m], for the radius r [m] and the stiffness k_c [N/m].
ActivationValue activation_at(compare::ContactActivation kind, double distance, double contact_radius,
                              double stiffness);

}  // namespace ogc::reference
