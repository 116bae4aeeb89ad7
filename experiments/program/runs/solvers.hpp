// Lists the solvers of `ogc run` and the options that each of them has.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "compare/contestant.hpp"
#include "compare/problem/settings.hpp"

namespace ogc::experiments {

/// The method that computes a step.
enum class Solver { vbd, newton, reference_vbd, ipc, penalty };

/// Returns the names for `--solver`, in the order of the enumeration.
std::span<const std::string_view> solver_names();
/// Throws compare::InputError that lists the names.
Solver parse_solver(std::string_view name);

/// Says which options belong to a solver.
struct SolverOptions {
  bool has_backends = false;           ///< --backend; the others run on the CPU
  bool has_condition = false;          ///< --condition
  bool has_measured_residual = false;  ///< --residual: the column holds Eq. 29
  bool has_traced_rows = false;        ///< --iterations writes rows of a trace that runs beside the simulation
  bool is_penalty = false;             ///< bounds=off and contact_activation=quadratic, whatever the scene says
};
/// Returns the options of one solver.
SolverOptions options_of(Solver solver);

/// Sets what the solver needs in the settings, which run.json then has. Throws compare::InputError if `assigned`, the
/// key=value of --set, contradicts it.
void require_settings(Solver solver, std::span<const std::string> assigned, compare::Settings& settings);

/// Returns the contestant of the solver. `on_device`: for solvers with backends.
compare::Contestant contestant_of(Solver solver, bool on_device);

}  // namespace ogc::experiments
