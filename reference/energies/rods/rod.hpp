#pragma once

#include "compare/stages/rod.hpp"

namespace ogc::reference {

/// Returns the answer to one case.
compare::ForceAnswer rod(const compare::RodCase& question);

/// Computes the stage `rod`.
compare::ForceTruth rod(const compare::RodIn& in);

}  // namespace ogc::reference
