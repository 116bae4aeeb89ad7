// Declares cases of volume_depth with tetrahedra: their generators, and a function that checks whether they are legal.
#pragma once

#include <span>
#include <string>

#include "compare/judge/cases/generators.hpp"

namespace ogc::compare {

/// Returns the generators of these cases, as rows of the stage's table.
std::span<const Generator> solid_depth_generators();

/// Returns why the tetrahedra or c.own are illegal; empty if they are legal. Reasons are
/// - a tetrahedron without four different vertices of the volume,
/// - a triangle that belongs to three tetrahedra, or to two tetrahedra on the same side of the triangle,
/// - a part whose triangles are not the boundary of its tetrahedra,
/// - an entry of c.own that is not a vertex of the surface, or not at the position of its point.
std::string solid_problem(const VolumeDepthCase& c);

}  // namespace ogc::compare
