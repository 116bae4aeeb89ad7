// Computes the data of Fig. 21d: the force of the contact energies over the distance. Differentiates the functions that
// Newton's method uses.
#pragma once

#include <array>

#include "reference/illustrations/illustrations.hpp"

namespace ogc::reference {

/// Returns two panels. The first has a layer for each activation, in the order of the setting: points (d, −g'(d), 0)
/// for r = 1 m, k_c = 1 N/m and 0 < d ≤ 1.1 r, with the values g''(d) [N/m]. The second has a layer for each κ of
/// `stiffness_ratios`: points (f, curvature_ratio(f, κ), 0), with the force f in units of k_c r.
std::vector<DrawingPanel> activation_drawing();

/// Values of κ: IPC's energy is −κ k_c (d − r)² ln(d/r), compared with OGC's energy of stiffness k_c. The paper's
/// drawing (Fig. 21d) has κ = 1.
inline constexpr std::array<double, 4> stiffness_ratios{1, 2, 7, 40};

/// Returns g''_IPC/g''_OGC at equal force. `force` is in units of k_c r and > 0. The two activations reach this force
/// at different distances.
double curvature_ratio(double force, double stiffness_ratio);

}  // namespace ogc::reference
