// Declares cases of volume_depth about tetrahedra: where they come from, and which are legal.
#pragma once

#include <span>
#include <string>

#include "compare/judge/cases/generators.hpp"

namespace ogc::compare {

/// Returns their rows of the stage's table.
std::span<const Generator> solid_depth_generators();

/// Says why a volume may not have these tetrahedra: a corner that is not a vertex, a triangle with three of them or
/// with two on one side, a part whose triangles are not their boundary. Says also why `own` is illegal: a vertex that
/// is not on the surface or does not lie where its point does. Empty where nothing is wrong.
std::string solid_problem(const VolumeDepthCase& c);

}  // namespace ogc::compare
