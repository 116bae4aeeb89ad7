// Defines which questions of stage rest_state are legal.
#pragma once

#include <string>

#include "compare/judge/cases/cases.hpp"

namespace ogc::compare {

/// Returns what makes the case illegal (compare/stages/rest_state.hpp), as one message; empty if it is legal.
std::string problems_of(const RestStateCase& c);

}  // namespace ogc::compare
