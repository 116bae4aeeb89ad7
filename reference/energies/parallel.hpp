// All cases of a batch, in parallel over them: each case has its place, so threads change nothing.
#pragma once

#include <tbb/parallel_for.h>

#include "compare/stages/force.hpp"

namespace ogc::reference {

/// `answers_of` gives the acceptable answers of one case, the exact one first.
template <class Case, class AnswersOf>
compare::ForceTruth for_all(const std::vector<Case>& cases, AnswersOf answers_of) {
  compare::ForceTruth truth;
  truth.accepted.resize(cases.size());
  tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t i) { truth.accepted[i] = answers_of(cases[i]); });
  return truth;
}

}  // namespace ogc::reference
