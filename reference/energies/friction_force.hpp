// Computes the stage friction_force: IPC's lagged friction at the contact points of one contact (method.md §4.4).
#pragma once

#include "compare/stages/friction_force.hpp"
#include "reference/energies/meeting.hpp"

namespace ogc::reference {

/// Returns the exact answer first. The answers for the other accepted positions of the contact points follow.
std::vector<compare::ForceAnswer> friction_force(const compare::FrictionForceCase& question);

/// Computes all cases, in parallel over them.
compare::ForceTruth friction_force(const compare::FrictionForceIn& in);

}  // namespace ogc::reference
