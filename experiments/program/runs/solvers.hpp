// The solvers of `ogc run`, and which of its options each of them has.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "compare/contestant.hpp"
#include "compare/problem/settings.hpp"

namespace ogc::experiments {

/// Who computes a step.
enum class Solver { vbd, newton, reference_vbd, ipc, penalty };

/// Of `--solver`, in the order of the enumeration.
std::span<const std::string_view> solver_names();
/// Throws compare::InputError that names what there is.
Solver parse_solver(std::string_view name);

/// Which options belong to a solver.
struct SolverOptions {
  bool has_backends = false;           ///< --backend; the others run on the CPU
  bool has_condition = false;          ///< --condition
  bool has_measured_residual = false;  ///< --residual: the column holds Eq. 29
  bool has_traced_rows = false;        ///< --iterations writes rows of a trace beside the run
  bool is_penalty = false;             ///< bounds=off and activation=quadratic, whatever the scene says
};
/// Of one solver.
SolverOptions options_of(Solver solver);

/// What the solver needs of the settings, which run.json then has. Throws compare::InputError where `assigned`, the
/// key=value of --set, asks for something else.
void require_settings(Solver solver, std::span<const std::string> assigned, compare::Settings& settings);

/// Who computes it. `on_device`: for solvers with backends.
compare::Contestant contestant_of(Solver solver, bool on_device);

}  // namespace ogc::experiments
