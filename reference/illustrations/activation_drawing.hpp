// Fig. 21d: force over distance of the contact energies, by differentiating the same functions as Newton's method.
#pragma once

#include <array>

#include "reference/illustrations/illustrations.hpp"

namespace ogc::reference {

/// Returns two panels. The first has a layer for each activation in the order of the setting: points (d, −g'(d), 0) for
/// r = 1 m and k_c = 1 N/m, 0 < d ≤ 1.1 r, with g''(d) [N/m] as their values. The second has a layer for each stiffness
/// ratio κ of `stiffness_ratios`: points (f, ratio, 0), f in units of k_c r.
std::vector<DrawingPanel> activation_drawing();

/// κ: IPC's energy is −κ k_c (d − r)² ln(d/r), compared with OGC's of stiffness k_c; in the paper's drawing (Fig. 21d)
/// κ = 1.
inline constexpr std::array<double, 4> stiffness_ratios{1, 2, 7, 40};

/// Returns g''_IPC/g''_OGC where both push with the force f k_c r, each at its own distance. f > 0.
double curvature_ratio(double force, double stiffness_ratio);

}  // namespace ogc::reference
