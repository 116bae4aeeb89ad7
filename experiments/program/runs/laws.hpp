// Runs laws of motion (compare/laws) with several solvers, and reports the verdicts as text and JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/laws/law.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/runs/solvers.hpp"

namespace ogc::experiments {

/// Selects a solver and its bounds. Bounds affect only the motion of vbd.
struct LawAsked {
  Solver solver = Solver::vbd;                     ///< one of vbd, newton, ipc
  bool on_device = false;                          ///< vbd runs on CUDA
  compare::Bounds bounds = compare::Bounds::ball;  ///< ball or planes
};

/// Holds the result of one law for one solver.
struct LawRow {
  const compare::Law* law = nullptr;
  LawAsked asked;
  bool was_asked = true;  ///< false: the law does not apply; `why` then names what the solver lacks
  /// Verdict on the readings. It is broken if the run ends early or the solver refuses the scene; `why` then gives the
  /// reason.
  compare::Verdict verdict = compare::Verdict::holds;
  std::string why;                         ///< reason for `was_asked` or `verdict`, or the derivation of a limit
  std::vector<compare::Reading> readings;  ///< in the law's order
  double seconds = 0;                      ///< duration of the runs [s]
};

/// Runs the law's scenes and reads the results.
LawRow ask(const compare::Law& law, compare::LawSize size, const LawAsked& asked);

/// Returns whether any verdict is broken.
bool any_broken(const std::vector<LawRow>& rows);

/// Returns a table of the rows with the worst reading of each, and a line that counts the verdicts.
std::string describe(const std::vector<LawRow>& rows);
/// Returns the report "ogc laws 1" (schema: experiments/laws.schema.json).
Json law_json(const std::vector<LawRow>& rows, compare::LawSize size);
/// Returns the schema of the report.
std::string laws_schema();

/// Returns the laws by group for `--list`, with what they test and their closed solutions.
std::string list_laws();

}  // namespace ogc::experiments
