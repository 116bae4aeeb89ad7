// Decides which generators are used for a contestant.
#pragma once

#include "compare/contestant.hpp"
#include "compare/judge/cases/generators.hpp"

namespace ogc::compare {

/// Checks whether the contestant has the other stages and the features (volumes, rods, cavities, dat) that the
/// generator's cases need besides the judged stage.
bool is_asked(const Contestant& contestant, Stage stage, const Generator& generator);

}  // namespace ogc::compare
