// Declares cases of volume_depth with tetrahedra: their generators and which of them are legal.
#pragma once

#include <span>
#include <string>

#include "compare/judge/cases/generators.hpp"

namespace ogc::compare {

/// Returns the generators of these cases, as rows of the stage's table.
std::span<const Generator> solid_depth_generators();

/// Returns why the tetrahedra or `own` are illegal; empty if they are legal.
/// - Tetrahedra: a corner is no vertex; a triangle belongs to three tetrahedra, or to two on the same side; the
///   triangles of a part are not the boundary of its tetrahedra.
/// - `own`: a vertex is not on the surface, or not where its point is.
std::string solid_problem(const VolumeDepthCase& c);

}  // namespace ogc::compare
