// Stage bound: Eq. 21, 23, 25.
#pragma once

#include "compare/stages/bound.hpp"

namespace ogc::reference {

/// Computes b_v = γ_p min(d_min,v, d_min,e of v's edges, d_min,t of v's triangles), rounded down.
compare::BoundTruth bound(const compare::BoundIn& in);

/// Returns a · b, rounded down; a, b ≥ 0.
float product_below(float a, float b);

}  // namespace ogc::reference
