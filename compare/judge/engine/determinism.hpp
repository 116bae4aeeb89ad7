// Checks whether the same questions get the same bits: when repeated, with other numbers of threads, alone or together
// with other cases, and in another order. No truth is needed.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/judge/cases/generators.hpp"

namespace ogc::compare {

/// Returns the bits of the contestant's answers, one string for each case. Strings are equal if and only if all numbers
/// are equal, including signs of zeros and payloads of NaNs. The authority completes the questions, for example with
/// the contacts of a sweep. All cases must be of one stage.
std::vector<std::string> answer_bits(Stage stage, std::span<const TestCase> cases, const Contestant& contestant,
                                     const Authority& authority);

/// Conditions that must not change a bit, for example another number of threads.
struct Surrounding {
  std::string name;                                       ///< for the report: "2 threads"
  std::function<void(const std::function<void()>&)> run;  ///< calls its argument once
};

/// The digest of a stage's answers, and the conditions under which bits of answers changed.
struct DeterminismReport {
  Stage stage = Stage::rest_state;  ///< the stage under test
  std::uint64_t cases = 0;          ///< number of cases; a mesh counts once
  /// FNV-1a of all answers in order; equal on two machines or builds that give the same bits
  std::uint64_t digest = 0;
  /// one line for each condition that changed bits: its name, the number of changed cases, the first changed case
  std::vector<std::string> changed;
  bool skipped = false;  ///< the contestant does not have the stage
};

/// Asks the contestant about `cases` cases of all generators (a mesh counts once) several times: shuffled, one by one,
/// in batches of 2, 3, 5, 10 and 50, and under each of `surroundings`. Generic cases of stages with
/// StageTraits::is_same_renumbered are also asked with renumbered vertices and triangles.
DeterminismReport check_determinism(Stage stage, std::uint64_t cases, std::uint64_t seed, const Contestant& contestant,
                                    const Authority& authority, std::span<const Surrounding> surroundings);

/// Returns a table with one row for each stage: stage, stated level (compare/judge/cases/stage_traits.hpp), cases,
/// digest, what changed.
std::string determinism_table(std::span<const DeterminismReport> reports);

}  // namespace ogc::compare
