// Decides which generators are used for a contestant.
#pragma once

#include "compare/contestant.hpp"
#include "compare/judge/cases/generators.hpp"

namespace ogc::compare {

/// Checks whether the contestant has all that the generator's cases need in addition to the judged stage.
bool is_asked(const Contestant& contestant, Stage stage, const Generator& generator);

}  // namespace ogc::compare
