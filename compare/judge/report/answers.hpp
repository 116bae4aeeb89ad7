// Holds both answers to a case whole: each output of the stage by name and unit, from the contestant and from the
// authority.
#pragma once

#include "compare/contestant.hpp"
#include "compare/judge/report/inputs.hpp"

namespace ogc::compare {

/// One output. In a sweep or a step the exact values follow from the contestant's own answer
/// (compare/stages/sweep.hpp).
struct AnswerPair {
  Quantity given, exact;  ///< `given` is empty where there is no answer
};

/// All outputs of a case.
struct Answers {
  std::vector<AnswerPair> outputs;  ///< in the contract's order
  std::string note;                 ///< why there is no answer, or that more than one is right; otherwise empty
};

/// Puts given and exact outputs side by side; where the given list is shorter, the rest is empty.
Answers paired(const std::vector<Quantity>& given, const std::vector<Quantity>& exact, std::string note);

/// Asks both sides.
Answers answers_to(const TestCase& test, const Contestant& contestant, const Authority& authority);

}  // namespace ogc::compare
