// Holds the outputs of contestant and authority for one case, by name and unit.
#pragma once

#include "compare/contestant.hpp"
#include "compare/judge/report/inputs.hpp"

namespace ogc::compare {

/// One output of contestant and authority. In a sweep or a step the exact values follow from the contestant's own
/// answer (compare/stages/sweep.hpp).
struct AnswerPair {
  Quantity given, exact;  ///< `given` is empty if there is no answer
};

/// All outputs of a case.
struct Answers {
  std::vector<AnswerPair> outputs;  ///< in the contract's order
  std::string note;                 ///< why there is no answer, or that several are right; may be empty
};

/// Pairs given and exact outputs by position. If the given list is shorter, its missing outputs are empty.
Answers paired(const std::vector<Quantity>& given, const std::vector<Quantity>& exact, std::string note);

/// Returns the answers of contestant and authority.
Answers answers_to(const TestCase& test, const Contestant& contestant, const Authority& authority);

}  // namespace ogc::compare
