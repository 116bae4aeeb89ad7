// Declares the contestant whose mutants tests/mutants/judge.cpp judges.
#pragma once

#include "compare/contestant.hpp"

namespace ogc::tests {

compare::Contestant mutant_contestant();

}  // namespace ogc::tests
