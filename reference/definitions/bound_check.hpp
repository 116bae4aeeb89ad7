// Checks whether given bounds are safe. Compares b_v with exact distances, stored as fractions of their squares (Eq.
// 21–26), because a rounded distance could decide wrongly.
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
