#pragma once

#include <vector>

#include "compare/stages/orientation.hpp"

namespace ogc::reference {

/// Returns the accepted answers to one case, the exact one first. There are several if rounding may change the sign of
/// t·q: q is the old orientation, t is an orientation towards which a neighbour pulls the segment.
std::vector<compare::OrientationAnswer> orientation(const compare::OrientationCase& question);

/// Stage orientation. Finds minimisers by Newton's method on the unit sphere from many starts, with the last steps in
/// 113 bits. Uses no eigenvalue, root or closed form.
compare::OrientationTruth orientation(const compare::OrientationIn& in);

}  // namespace ogc::reference
