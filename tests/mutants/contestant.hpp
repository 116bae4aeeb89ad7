// The contestant whose mutants tests/mutants/judge.cpp judges.
#pragma once

#include "compare/problem/contestant.hpp"

namespace ogc::tests {

compare::Contestant mutant_contestant();

}  // namespace ogc::tests
