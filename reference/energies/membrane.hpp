// Stage membrane: the St. Venant–Kirchhoff energy of one triangle (scenes.md; method.md §4).
#pragma once

#include "compare/stages/membrane.hpp"

namespace ogc::reference {

compare::ForceAnswer membrane(const compare::MembraneCase& question);

/// All cases, in parallel over them.
compare::ForceTruth membrane(const compare::MembraneIn& in);

}  // namespace ogc::reference
