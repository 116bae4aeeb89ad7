// Declares cases of volume_depth: their generators and which of them are legal.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/legal.hpp"

namespace ogc::compare {

/// Returns the stage's table.
std::span<const Generator> volume_depth_generators();

/// Returns why the surface is no volume; empty if it is one. Reasons are a triangle without area or lower than 2⁻²⁰ of
/// its longest side, two triangles that traverse an edge in the same direction, and an edge without a triangle.
std::string volume_problem(const Topology& topology, const std::vector<Vec3f>& positions);

/// Makes a volume with rims from triangles of a frame. Leaves out triangles without area, and triangles that traverse
/// an edge in the same direction as an earlier triangle. Points are vertices of the frame, moved by up to r.
VolumeDepthCase volume_of_state(const MeshCase& state, Random& random);

}  // namespace ogc::compare
