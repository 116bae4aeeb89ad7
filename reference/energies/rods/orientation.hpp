#pragma once

#include <vector>

#include "compare/stages/orientation.hpp"

namespace ogc::reference {

/// Returns the answers to one case, the exact one first; several where a sign is grey.
std::vector<compare::OrientationAnswer> orientation(const compare::OrientationCase& question);

/// The stage `orientation`: finds minimisers by Newton's method on the unit sphere from many starts, the last steps in
/// 113 bits. It uses no eigenvalue, root or closed form.
compare::OrientationTruth orientation(const compare::OrientationIn& in);

}  // namespace ogc::reference
