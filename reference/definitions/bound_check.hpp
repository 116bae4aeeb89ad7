// Checks whether given bounds are safe. Decides on the squared distances as quotients (Eq. 21–26), so that "b_v is at
// most the exact one" is a fact and not a comparison of two roundings.
#pragma once

#include <span>
#include <vector>

#include "compare/stages/detect.hpp"

namespace ogc::reference {

/// Returns the vertices with b_v > γ_p min(r_q, d_min,v, d_min,e of its edges, d_min,t of its triangles), ascending.
/// `bounds` [m] by vertex; a bound that is not finite counts as too large. Throws InputError where there is not one
/// bound for each vertex.
std::vector<compare::Index> bounds_above_exact(const compare::DetectIn& in, float bounds_relaxation,
                                               std::span<const float> bounds);

}  // namespace ogc::reference
