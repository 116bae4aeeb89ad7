// The reference as the judge's authority: exact where the answer is discrete, correctly bounded where it is not.
#pragma once

#include "compare/problem/contestant.hpp"

namespace ogc::reference {

/// Every stage that the reference has.
compare::Authority authority();

}  // namespace ogc::reference
