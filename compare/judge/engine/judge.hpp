// Drives a contestant and an authority through the same cases, stage by stage; the judge never learns which programs
// they are.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/judge/cases/generators.hpp"
#include "compare/judge/engine/diagnosis.hpp"
#include "compare/judge/engine/tally.hpp"

namespace ogc::compare {

/// How much the judge asks, and how.
struct JudgeOptions {
  std::uint64_t cases = 100000;  ///< cases of each stage; a mesh stage ends with the mesh that reaches the number
  std::uint64_t seed = 1;        ///< seed of the generators
  /// threads that generate, ask the authority and judge; one thread at a time asks the contestant
  unsigned threads = 2;
  std::uint64_t batch = 1u << 14;  ///< cases put to a pair stage at once
  std::string generator;           ///< only this generator; all where empty
  const States* states = nullptr;  ///< real states to take cases from, besides
  /// Called by one thread at a time after each batch, with the cases judged so far and the mismatches so far.
  std::function<void(std::uint64_t, std::uint64_t)> progress;
};

/// What the judge found about a stage.
struct StageReport {
  Tally tally;                           ///< all counts and errors
  double seconds = 0;                    ///< time of both sides and the judge
  bool skipped = false;                  ///< the contestant or the authority does not have the stage
  std::optional<Diagnosis> diagnosis{};  ///< diagnosis of the failures, where one was wanted (report/diagnose.hpp)
  std::string note{};                    ///< why the given run has no cases for the stage; otherwise empty
  /// Checks that there is no mismatch, at least one case, and a grey share of the generic generators within its limit.
  bool passed() const;
};

/// Checks whether both sides have the stage.
bool can_judge(Stage stage, const Contestant& contestant, const Authority& authority);

/// A stage ends after this many failures of the contestant (ContestantFailure), with the cases judged so far.
inline constexpr std::uint64_t failures_allowed = 3;

/// Judges generated cases of one stage. The report depends on cases, seed, batch and generators, not on threads. A
/// ContestantFailure becomes a mismatch of the case that provokes it; whatever else a contestant throws reaches the
/// caller.
StageReport judge_stage(Stage stage, const Contestant& contestant, const Authority& authority,
                        const JudgeOptions& options);

/// Judges given cases (a batch file, a replay), grouped by stage in the order of `all_stages`.
std::vector<StageReport> judge_cases(std::span<const TestCase> cases, const Contestant& contestant,
                                     const Authority& authority);

}  // namespace ogc::compare
