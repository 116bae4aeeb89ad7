// Stage bending: the energy of one hinge (method.md §4.7, §4.9).
#pragma once

#include "compare/stages/bending.hpp"

namespace ogc::reference {

struct RestBuilder;

/// Returns the exact answer; where an angle is near ±π also those on the other side of the cut.
std::vector<compare::ForceAnswer> bending(const compare::BendingCase& question);

/// Computes all cases, in parallel over them.
compare::ForceTruth bending(const compare::BendingIn& in);

/// Adds the rest data of hinges (solvers/kinds/rest_state.cpp).
void add_hinges_at_rest(RestBuilder& to);

}  // namespace ogc::reference
