// Stage membrane: the energy of one triangle (method.md §4.6, §4.9).
#pragma once

#include "compare/stages/membrane.hpp"

namespace ogc::reference {

/// Returns the exact answer. For a collapsed triangle of the stable Neo-Hookean model, whose normal is undefined, an
/// answer that covers every normal follows.
std::vector<compare::ForceAnswer> membrane(const compare::MembraneCase& question);

/// Computes all cases, in parallel over them.
compare::ForceTruth membrane(const compare::MembraneIn& in);

}  // namespace ogc::reference
