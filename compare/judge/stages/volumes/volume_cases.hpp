// Declares cases of volume_depth: where they come from, and which are legal.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/legal.hpp"

namespace ogc::compare {

/// Returns the stage's table.
std::span<const Generator> volume_depth_generators();

/// Says what makes the surface no volume: a triangle without area or lower than 2⁻²⁰ of its longest side, an edge that
/// two triangles run through in one sense, or an edge of no triangle. Empty where nothing does.
std::string volume_problem(const Topology& topology, const std::vector<Vec3f>& positions);

/// Makes a volume with rims of those triangles of a frame that fit together; its points are vertices of the frame,
/// moved by up to r.
VolumeDepthCase volume_of_state(const MeshCase& state, Random& random);

}  // namespace ogc::compare
