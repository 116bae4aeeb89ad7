// Both answers to a case, whole: each output of the stage by name and unit, as the contestant gave it and as the
// authority does.
#pragma once

#include "compare/judge/explain/inputs.hpp"
#include "compare/problem/contestant.hpp"

namespace ogc::compare {

/// One output. Of a sweep or a step the exact values are those that follow from the contestant's own answer
/// (compare/stages/sweep.hpp).
struct AnswerPair {
  Quantity given, exact;  ///< `given` is empty where there is no answer
};

struct Answers {
  std::vector<AnswerPair> outputs;
  std::string note;  ///< why there is no answer, or that more than one is right; otherwise empty
};

/// Asks both.
Answers answers_to(const TestCase& test, const Contestant& contestant, const Authority& authority);

}  // namespace ogc::compare
