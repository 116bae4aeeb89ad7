// Planes between near pairs and balls for all others, by definition (method.md §5.6).
#pragma once

#include "compare/stages/plane.hpp"

namespace ogc::reference {

/// Of each pair within r_q the closest points c_p, c_q, found exactly, give n = (c_q − c_p)/d; its two offsets lie
/// γ_p d from the sides, or 2γ_p d from one where the other is fixed. A pair gets the plane if every vertex keeps it in
/// single precision, exactly, and if it is nearer than the 17th nearest pair of each of its vertices that can move; the
/// others limit the balls. In parallel; the answer does not depend on the number of threads.
compare::PlaneOut pair_planes(const compare::PlaneIn& in);

}  // namespace ogc::reference
