// Stage volume_depth: the answer of part_contacts with all alternatives of its grey decisions.
#pragma once

#include "compare/stages/volume_depth.hpp"

namespace ogc::reference {

/// Computes all points, in parallel over them. Triangles must have an area; each edge must have one triangle, or two
/// that run through it in opposite senses.
compare::VolumeDepthTruth volume_depth(const compare::VolumeDepthIn& in);

}  // namespace ogc::reference
