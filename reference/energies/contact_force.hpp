// Computes the stage contact_force: force and block of one contact from its closest points (Eq. 1, 16, 18–20; method.md
// §3.5, §4.2).
#pragma once

#include "compare/stages/contact_force.hpp"
#include "reference/energies/meeting.hpp"

namespace ogc::reference {

/// Returns the exact answer first. Answers for all other outcomes of grey decisions follow. The decisions are the
/// features of the closest points, the branch of the activation, and d < r.
std::vector<compare::ForceAnswer> contact_force(const compare::ContactForceCase& question);

/// Computes all cases, in parallel over them.
compare::ForceTruth contact_force(const compare::ContactForceIn& in);

}  // namespace ogc::reference
