#pragma once

#include "compare/stages/rod.hpp"

namespace ogc::reference {

/// The answer to one case.
compare::ForceAnswer rod(const compare::RodCase& question);

/// The stage `rod`.
compare::ForceTruth rod(const compare::RodIn& in);

}  // namespace ogc::reference
