// Stage volume_depth: the answer of part_contacts with all that its grey decisions could say instead.
#pragma once

#include "compare/stages/volume_depth.hpp"

namespace ogc::reference {

/// All points, in parallel over them. Triangles have an area; each edge has one triangle, or two that run through it in
/// opposite senses.
compare::VolumeDepthTruth volume_depth(const compare::VolumeDepthIn& in);

}  // namespace ogc::reference
