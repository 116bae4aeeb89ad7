// Stage tetrahedron by automatic differentiation of its energy.
#pragma once

#include "compare/stages/tetrahedron.hpp"

namespace ogc::reference {

/// Returns the exact answer.
compare::ForceAnswer tetrahedron(const compare::TetrahedronCase& question);

/// Computes all cases, in parallel over them.
compare::ForceTruth tetrahedron(const compare::TetrahedronIn& in);

}  // namespace ogc::reference
