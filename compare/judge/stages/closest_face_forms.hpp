// Wrong forms of the stage closest_face: answers that known mistakes give.
#pragma once

#include <vector>

#include "compare/judge/report/wrong_forms.hpp"

namespace ogc::compare {

/// Weights and corners that are exchanged, an edge or a corner that is not the nearest, areas that add up, absolute
/// thresholds, rounded decisions, and answers that are no numbers where a triangle is a needle.
std::vector<WrongForm> closest_face_forms();

}  // namespace ogc::compare
