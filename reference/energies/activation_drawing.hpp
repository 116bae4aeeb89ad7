// Fig. 21d: force over distance of the contact energies, by differentiating the very functions that Newton differentiates.
#pragma once

#include "reference/geometry/illustrations.hpp"

namespace ogc::reference {

/// One panel, a layer for each activation in the order of the setting: points (d, −g'(d), 0) for r = 1 m and k_c = 1 N/m, 0 < d ≤ 1.1 r, and g''(d) [N/m] as
/// their values.
std::vector<DrawingPanel> activation_drawing();

}  // namespace ogc::reference
