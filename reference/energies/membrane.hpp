// Computes the stage membrane: force and block of one corner of a triangle (method.md §4.6, §4.9).
#pragma once

#include "compare/stages/membrane.hpp"

namespace ogc::reference {

struct RestBuilder;

/// Returns the exact answer. If the stable Neo-Hookean model has no normal, because the triangle may have collapsed,
/// also returns an answer that covers every normal.
std::vector<compare::ForceAnswer> membrane(const compare::MembraneCase& question);

/// Computes all cases, in parallel over them.
compare::ForceTruth membrane(const compare::MembraneIn& in);

/// Adds the rest data of triangles (solvers/kinds/rest_state.cpp).
void add_triangles_at_rest(RestBuilder& to);

}  // namespace ogc::reference
