// Computes the stage bending: force and block of one vertex of a hinge (method.md §4.7, §4.9).
#pragma once

#include "compare/stages/bending.hpp"

namespace ogc::reference {

struct RestBuilder;

/// Returns the exact answer. If an angle is near ±π, also returns the answers for this angle ∓ 2π.
std::vector<compare::ForceAnswer> bending(const compare::BendingCase& question);

/// Computes all cases, in parallel over them.
compare::ForceTruth bending(const compare::BendingIn& in);

/// Adds the rest data of hinges (solvers/kinds/rest_state.cpp).
void add_hinges_at_rest(RestBuilder& to);

}  // namespace ogc::reference
