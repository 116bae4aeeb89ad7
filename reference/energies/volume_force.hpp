// Stage volume_force: the energy of one contact with a volume, and its friction (§3.9; method.md §9).
#pragma once

#include "compare/stages/volume_force.hpp"

namespace ogc::reference {

/// The exact answer; where r − φ is grey, that of the other side of the jump, too.
std::vector<compare::ForceAnswer> volume_force(const compare::VolumeForceCase& question);

/// All cases, in parallel over them.
compare::ForceTruth volume_force(const compare::VolumeForceIn& in);

}  // namespace ogc::reference
