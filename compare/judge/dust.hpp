// Small coordinates: what rotations leave of a zero, and runs of a vertex near a plane of symmetry (method.md §2.4:
// legal everywhere).
#pragma once

#include "compare/judge/cases.hpp"
#include "compare/judge/random.hpp"

namespace ogc::compare {

/// Makes some coordinates of the case small, down to 2⁻⁶⁰ (10⁻¹⁸), each by itself, as long as the case stays legal.
/// Products of two that are smaller still are lost beside 1 in double-double, and so are decisions. Connectivity,
/// radii, materials and rest data stay. Scenes stay as they are, but for the positions of a sweep.
void add_dust(Random& random, CaseData& data);

}  // namespace ogc::compare
