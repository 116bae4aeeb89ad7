// Computes all cases of a batch in parallel. Each case writes to a separate element of the result, so the result does
// not depend on the number of threads.
#pragma once

#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "compare/stages/force.hpp"

namespace ogc::reference {

/// The truth about one case: the accepted answers, and whether a decision is near.
struct Accepted {
  std::vector<compare::ForceAnswer> answers;  ///< the exact one first
  bool near = false;                          ///< whether some decision lies within near_factor of its boundary
  Accepted(std::vector<compare::ForceAnswer> all, bool is_near = false) : answers(std::move(all)), near(is_near) {}
};

/// Computes the truth about each case with the function `truth_of`.
template <class Case, class TruthOf>
compare::ForceTruth for_all(const std::vector<Case>& cases, TruthOf truth_of) {
  compare::ForceTruth truth{std::vector<std::vector<compare::ForceAnswer>>(cases.size()),
                            std::vector<std::uint8_t>(cases.size())};
  tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t i) {
    Accepted accepted = truth_of(cases[i]);
    truth.accepted[i] = std::move(accepted.answers);
    truth.near[i] = accepted.near;
  });
  return truth;
}

}  // namespace ogc::reference
