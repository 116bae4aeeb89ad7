// Computes the stage volume_force: force and block of one contact with a volume, with friction (§3.9; method.md §9).
#pragma once

#include "compare/stages/volume_force.hpp"

namespace ogc::reference {

/// Returns the exact answer. If the sign of r − φ is grey, the answer for the other sign follows.
std::vector<compare::ForceAnswer> volume_force(const compare::VolumeForceCase& question);

/// Computes all cases, in parallel over them.
compare::ForceTruth volume_force(const compare::VolumeForceIn& in);

}  // namespace ogc::reference
