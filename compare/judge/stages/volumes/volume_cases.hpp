// Cases of volume_depth: where they come from, and which are legal.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/legal.hpp"

namespace ogc::compare {

/// The stage's table.
std::span<const Generator> volume_depth_generators();

/// What makes the surface no volume: a triangle without area, or lower than 2⁻²⁰ of its longest side, an edge that two
/// triangles run through in one sense or that none has; empty where nothing does.
std::string volume_problem(const Topology& topology, const std::vector<Vec3f>& positions);

/// The triangles of a frame, as far as they are one volume with rims; points are vertices of the frame, moved by up to
/// r.
VolumeDepthCase volume_of_state(const MeshCase& state, Random& random);

}  // namespace ogc::compare
