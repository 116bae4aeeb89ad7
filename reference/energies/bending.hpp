// Stage bending: the energy of one hinge (method.md §4.7, §4.9).
#pragma once

#include "compare/stages/bending.hpp"

namespace ogc::reference {

/// Returns the exact answer first. If the angle is near ±π, the answers for the angle minus or plus 2π follow.
std::vector<compare::ForceAnswer> bending(const compare::BendingCase& question);

/// Computes all cases, in parallel over them.
compare::ForceTruth bending(const compare::BendingIn& in);

}  // namespace ogc::reference
