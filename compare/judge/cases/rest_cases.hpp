// Defines a legal question of stage rest_state.
#pragma once

#include <string>

#include "compare/judge/cases/cases.hpp"

namespace ogc::compare {

/// Says what makes the case illegal (compare/stages/rest_state.hpp), as one message; empty where nothing does.
std::string problems_of(const RestStateCase& c);

}  // namespace ogc::compare
