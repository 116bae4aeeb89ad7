// Stage volume_depth: computes the contacts that part_contacts defines, with an answer for each outcome of a grey
// decision.
#pragma once

#include "compare/stages/volume_depth.hpp"

namespace ogc::reference {

/// Computes all points, in parallel. Each triangle must have an area; each edge must have one triangle, or two that run
/// through it in opposite senses.
compare::VolumeDepthTruth volume_depth(const compare::VolumeDepthIn& in);

}  // namespace ogc::reference
