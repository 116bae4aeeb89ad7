// Runs laws of motion (compare/laws) with solvers: the solvers to run, the verdicts, and the report as text and JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/laws/law.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/runs/solvers.hpp"

namespace ogc::experiments {

/// Names a solver and its bounds. Bounds affect the motion of vbd alone.
struct LawAsked {
  Solver solver = Solver::vbd;                     ///< one of vbd, newton, ipc
  bool on_device = false;                          ///< vbd on CUDA
  compare::Bounds bounds = compare::Bounds::ball;  ///< ball or planes
};

/// Holds a law and the answer of one solver.
struct LawRow {
  const compare::Law* law = nullptr;  ///< the law
  LawAsked asked;                     ///< the solver
  bool was_asked = true;              ///< false: the law does not apply, and `why` names what this solver lacks
  /// The verdict of the readings. A run that ends early, or that the solver refuses, is broken; `why` then says how.
  compare::Verdict verdict = compare::Verdict::holds;
  std::string why;                         ///< a reason for `was_asked` or `verdict`; the derivation of a limit
  std::vector<compare::Reading> readings;  ///< in the law's order
  double seconds = 0;                      ///< duration [s]
};

/// Runs the law's scenes and reads the results.
LawRow ask(const compare::Law& law, compare::LawSize size, const LawAsked& asked);

/// Returns whether any row's law is broken.
bool any_broken(const std::vector<LawRow>& rows);

/// Returns a table of rows with the worst reading of each, and a line with the number of each verdict.
std::string describe(const std::vector<LawRow>& rows);
/// Returns the report "ogc laws 1", whose schema is experiments/laws.schema.json.
Json law_json(const std::vector<LawRow>& rows, compare::LawSize size);
/// Returns that schema as text.
std::string laws_schema();

/// Returns the laws by group, with what they prove and their closed answers, for `--list`.
std::string list_laws();

}  // namespace ogc::experiments
