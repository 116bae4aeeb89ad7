// Stage spring: the energy of one spring (method.md §4.8, §4.9).
#pragma once

#include "compare/stages/spring.hpp"

namespace ogc::reference {

/// Returns the exact answer of one case (compare/stages/spring.hpp).
compare::ForceAnswer spring(const compare::SpringCase& question);

/// Computes all cases, in parallel over them.
compare::ForceTruth spring(const compare::SpringIn& in);

}  // namespace ogc::reference
