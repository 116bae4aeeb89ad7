// Stage bending: the energy of one hinge (method.md §4.7, §4.9).
#pragma once

#include "compare/stages/bending.hpp"

namespace ogc::reference {

/// Returns the exact answer; for an angle near ±π also the answers on the other side of the cut.
std::vector<compare::ForceAnswer> bending(const compare::BendingCase& question);

/// Computes all cases, in parallel over them.
compare::ForceTruth bending(const compare::BendingIn& in);

}  // namespace ogc::reference
