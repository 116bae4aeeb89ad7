// The parts of a scene's volumes, each with its facets in the order of a tree: made on the host.
#pragma once

#include <span>
#include <vector>

#include "compare/problem/scene.hpp"

namespace ogc::fast {

/// The parts of volumes: facets by part, in the order of their trees.
using VolumeParts = std::vector<std::vector<int>>;

/// Those of a scene, in the order of their lowest-numbered triangles; facets along a Hilbert curve at the scene's
/// start.
VolumeParts volume_parts(const compare::Scene& scene, const compare::Topology& topology);

/// Those of a topology whose triangles are all of one volume, at `positions`.
VolumeParts volume_parts(const compare::Topology& topology, std::span<const compare::Vec3f> positions);

}  // namespace ogc::fast
