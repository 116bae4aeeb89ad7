// Whether the same questions get the same bits: again, with other numbers of threads, alone and in company of other
// cases, in another order. Needs no truth.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/judge/cases/generators.hpp"

namespace ogc::compare {

/// The bits of the contestant's answers, one string a case; equal if and only if all numbers are, signs of zeros and
/// payloads included. The authority answers where a question needs it (the contacts of a sweep). All cases of one
/// stage.
std::vector<std::string> answer_bits(Stage stage, std::span<const TestCase> cases, const Contestant& contestant,
                                     const Authority& authority);

/// A way to ask that must not change a bit: runs what it is given, on other threads or under another limit.
struct Surrounding {
  std::string name;                                       ///< for the report: "2 threads"
  std::function<void(const std::function<void()>&)> run;  ///< calls its argument once
};

/// What a stage's answers depend on, though they must not.
struct DeterminismReport {
  Stage stage = Stage::rest_state;  ///< whose answers
  std::uint64_t cases = 0;          ///< how many, meshes whole
  /// FNV-1a of all answers in order: the same on two machines or builds that give the same bits
  std::uint64_t digest = 0;
  /// one line for each way of asking that changed bits: the way, how many cases, the first of them
  std::vector<std::string> changed;
  bool skipped = false;  ///< the contestant does not have the stage
};

/// Asks `cases` cases (whole meshes count one) of all generators again, shuffled, one by one and in batches of 2, 3, 5,
/// 10 and 50, and in each surrounding; the generic cases of stages whose answers do not depend on numbers
/// (StageTraits::is_same_renumbered) also under other numbers of vertices and triangles.
DeterminismReport check_determinism(Stage stage, std::uint64_t cases, std::uint64_t seed, const Contestant& contestant,
                                    const Authority& authority, std::span<const Surrounding> surroundings);

/// One row a stage: stage, level that is stated (compare/judge/cases/stage_traits.hpp), cases, digest, what changed.
std::string determinism_table(std::span<const DeterminismReport> reports);

}  // namespace ogc::compare
