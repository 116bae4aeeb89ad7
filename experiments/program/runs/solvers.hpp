// Lists the solvers of `ogc run` and the options that each solver has.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "compare/contestant.hpp"
#include "compare/problem/settings.hpp"

namespace ogc::experiments {

/// The method that computes a step.
enum class Solver { vbd, newton, reference_vbd, ipc, penalty };

/// Returns the values of `--solver`, in the order of the enumeration.
std::span<const std::string_view> solver_names();
/// Parses a value of `--solver`. Throws compare::InputError that lists the values.
Solver parse_solver(std::string_view name);

/// Describes which options a solver has.
struct SolverOptions {
  bool has_backends = false;           ///< --backend; without it the solver runs on the CPU
  bool has_condition = false;          ///< --condition
  bool has_measured_residual = false;  ///< --residual: the column holds Eq. 29
  bool has_traced_rows = false;        ///< whether --iterations writes rows that come from a trace
  bool is_penalty = false;             ///< always bounds=off and contact_activation=quadratic
};
/// Returns the options of one solver.
SolverOptions options_of(Solver solver);

/// Changes the settings to those that the solver requires; run.json then contains them. Throws compare::InputError if
/// `assigned`, the key=value of --set, contradicts them.
void require_settings(Solver solver, std::span<const std::string> assigned, compare::Settings& settings);

/// Returns the solver's contestant. `on_device`: for solvers with backends.
compare::Contestant contestant_of(Solver solver, bool on_device, int devices = 1);

}  // namespace ogc::experiments
