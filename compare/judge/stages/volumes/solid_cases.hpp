// Cases of volume_depth about tetrahedra: where they come from, and which are legal.
#pragma once

#include <span>
#include <string>

#include "compare/judge/cases/generators.hpp"

namespace ogc::compare {

/// Rows of the stage's table.
std::span<const Generator> solid_depth_generators();

/// What makes the tetrahedra none that a volume may have: a triangle of three of them or of two on one side, a part
/// whose triangles are not their boundary; and the vertices that ask none that may, or not where their points are.
/// Empty where nothing does.
std::string solid_problem(const VolumeDepthCase& c);

}  // namespace ogc::compare
