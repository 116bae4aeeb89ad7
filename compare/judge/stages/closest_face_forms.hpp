// Declares the wrong forms of stage closest_face.
#pragma once

#include <vector>

#include "compare/judge/report/wrong_forms.hpp"

namespace ogc::compare {

/// Returns forms that exchange weights or corners, choose an edge or corner that is not the nearest, add areas without
/// sign, use absolute thresholds, decide on rounded numbers, or answer NaN for needles.
std::vector<WrongForm> closest_face_forms();

}  // namespace ogc::compare
