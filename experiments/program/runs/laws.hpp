// Laws of motion (compare/laws) asked of solvers: who is asked, what becomes of it, and the report as text and JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/laws/law.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/runs/solvers.hpp"

namespace ogc::experiments {

/// Who answers, and with which bounds; those of no solver but vbd matter to its motion.
struct LawAsked {
  Solver solver = Solver::vbd;                     ///< one of vbd, newton, ipc
  bool on_device = false;                          ///< vbd on CUDA
  compare::Bounds bounds = compare::Bounds::ball;  ///< ball or planes
};

/// A law and what one of them answered.
struct LawRow {
  const compare::Law* law = nullptr;  ///< which
  LawAsked asked;                     ///< whom
  bool was_asked = true;              ///< false: `why` says what this solver lacks
  /// Of readings; a run that ends early, or that the solver refuses, is broken, and `why` says how.
  compare::Verdict verdict = compare::Verdict::holds;
  std::string why;                         ///< see above; of a limit its derivation
  std::vector<compare::Reading> readings;  ///< in the law's order
  double seconds = 0;                      ///< that it took
};

/// Moves the law's scenes and reads them.
LawRow ask(const compare::Law& law, compare::LawSize size, const LawAsked& asked);

/// Whether a law is broken in any row.
bool any_broken(const std::vector<LawRow>& rows);

/// A table of rows with the worst reading of each, and a line on how many hold.
std::string describe(const std::vector<LawRow>& rows);
/// "ogc laws 1", as experiments/laws.schema.json says.
Json law_json(const std::vector<LawRow>& rows, compare::LawSize size);
/// That schema, as text.
std::string laws_schema();

/// The laws by group with what they prove and their answers, for `--list`.
std::string list_laws();

}  // namespace ogc::experiments
