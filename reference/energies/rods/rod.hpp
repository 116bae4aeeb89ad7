#pragma once

#include "compare/stages/rod.hpp"

namespace ogc::reference {

/// Returns the answer to one case.
compare::ForceAnswer rod(const compare::RodCase& question);

/// Stage rod: computes all cases.
compare::ForceTruth rod(const compare::RodIn& in);

}  // namespace ogc::reference
