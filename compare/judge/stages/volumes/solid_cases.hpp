// Declares cases of volume_depth with tetrahedra: their generators and which of them are legal.
#pragma once

#include <span>
#include <string>

#include "compare/judge/cases/generators.hpp"

namespace ogc::compare {

/// Returns the generators of these cases, as rows of the stage's table.
std::span<const Generator> solid_depth_generators();

/// Returns why a volume may not have these tetrahedra; empty if it may. Reasons are a corner that is no vertex, a
/// triangle of three tetrahedra or of two on one side, and a part whose triangles are not the tetrahedra's boundary.
/// Also returns why `own` is illegal: a vertex is not on the surface, or not where its point is.
std::string solid_problem(const VolumeDepthCase& c);

}  // namespace ogc::compare
