// Cases as the questions that both sides are asked.
#pragma once

#include <vector>

#include "compare/judge/verdict.hpp"

namespace ogc::compare {

ClosestFaceIn face_question(Cases cases);
ClosestPointsIn points_question(Cases cases);
ActivationIn activation_question(Cases cases);
TruncateIn truncate_question(Cases cases);

/// In of a stage whose questions are its cases as they are.
template <class In, class Case>
In case_question(Cases cases, std::vector<Case> In::*questions) {
  In in;
  for (const TestCase& test : cases) (in.*questions).push_back(std::get<Case>(test.data));
  return in;
}

// Views of the case, which must outlive them.
DetectIn detect_question(const TestCase& test);
BoundIn bound_question(const TestCase& test);
BlockIn block_question(const TestCase& test);
RestStateIn rest_question(const TestCase& test);
StepIn step_question(const TestCase& test);

}  // namespace ogc::compare
