// Checks whether given bounds are safe. Compares squared distances as quotients (Eq. 21–26), so that no rounding of the
// exact bound decides.
#pragma once

#include <span>
#include <vector>

#include "compare/stages/detect.hpp"

namespace ogc::reference {

/// Returns the vertices with b_v > γ_p min(r_q, d_min,v, d_min,e of its edges, d_min,t of its triangles), ascending. A
/// bound that is not finite counts as too large. Throws InputError if `bounds` [m] does not have one entry for each
/// vertex.
std::vector<compare::Index> bounds_above_exact(const compare::DetectIn& in, float bounds_relaxation,
                                               std::span<const float> bounds);

}  // namespace ogc::reference
