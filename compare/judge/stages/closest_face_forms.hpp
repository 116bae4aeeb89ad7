// Lists the wrong forms of the stage closest_face: the answers that known mistakes give.
#pragma once

#include <vector>

#include "compare/judge/report/wrong_forms.hpp"

namespace ogc::compare {

/// Returns forms that exchange weights and corners, choose an edge or a corner that is not the nearest, add up areas,
/// use absolute thresholds, round decisions, or answer with no numbers where a triangle is a needle.
std::vector<WrongForm> closest_face_forms();

}  // namespace ogc::compare
