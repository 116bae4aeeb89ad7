// Stage membrane: the energy of one triangle (method.md §4.6, §4.9).
#pragma once

#include "compare/stages/membrane.hpp"

namespace ogc::reference {

/// The exact answer, then, where the stable Neo-Hookean model has no normal, one that holds for any.
std::vector<compare::ForceAnswer> membrane(const compare::MembraneCase& question);

/// All cases, in parallel over them.
compare::ForceTruth membrane(const compare::MembraneIn& in);

}  // namespace ogc::reference
