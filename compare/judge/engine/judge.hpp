// Gives a contestant and an authority the same cases, stage by stage, and judges the answers. The judge does not know
// which programs they are.
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

/// Extent and options of a judgement.
struct JudgeOptions {
  std::uint64_t cases = 100000;  ///< cases for each stage; the last mesh of a mesh stage may exceed the number
  std::uint64_t seed = 1;        ///< seed of the generators
  /// threads that generate, call the authority and judge; one thread at a time calls the contestant
  unsigned threads = 2;
  std::uint64_t batch = 1u << 14;  ///< cases in one question of a stage with single cases
  std::string generator;           ///< the only generator to use; empty: all
  const States* states = nullptr;  ///< real states from which cases are also taken
  /// Called after each batch with the numbers of cases and of mismatches so far, by one thread at a time.
  std::function<void(std::uint64_t, std::uint64_t)> progress;
};

/// What the judge found about a stage.
struct StageReport {
  Tally tally;           ///< all counts and errors
  double seconds = 0;    ///< time of contestant, authority and judge
  bool skipped = false;  ///< true if the contestant or the authority lacks the stage
  /// set if a diagnosis of the failures was requested (compare/judge/report/diagnose.hpp)
  std::optional<Diagnosis> diagnosis{};
  std::string note{};  ///< why the given run has no cases for the stage; otherwise empty
  /// Checks that there is at least one case and no mismatch, and that few decisions of the generic generators are grey.
  bool passed() const;
};

/// Checks whether contestant and authority have the stage.
bool can_judge(Stage stage, const Contestant& contestant, const Authority& authority);

/// A stage ends after this many failures of the contestant (ContestantFailure); it reports the cases judged so far.
inline constexpr std::uint64_t failures_allowed = 3;

/// Judges generated cases of one stage. The report depends on cases, seed, batch and generators, not on threads. A
/// ContestantFailure becomes a mismatch of the case that causes it; other exceptions of a contestant reach the caller.
StageReport judge_stage(Stage stage, const Contestant& contestant, const Authority& authority,
                        const JudgeOptions& options);

/// Judges given cases (a batch file, a replay), grouped by stage in the order of `all_stages`.
std::vector<StageReport> judge_cases(std::span<const TestCase> cases, const Contestant& contestant,
                                     const Authority& authority);

}  // namespace ogc::compare
