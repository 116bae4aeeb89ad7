#pragma once

#include <vector>

#include "compare/stages/orientation.hpp"

namespace ogc::reference {

/// Returns the accepted answers to one case, the exact one first. There are several if the sign of a product t·q is
/// grey.
std::vector<compare::OrientationAnswer> orientation(const compare::OrientationCase& question);

/// Stage orientation. Finds minimisers by Newton's method on the unit sphere from many starts, with the last steps in
/// 113 bits. Uses no eigenvalue, root or closed form.
compare::OrientationTruth orientation(const compare::OrientationIn& in);

}  // namespace ogc::reference
