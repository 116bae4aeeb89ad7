// `ogc laws`: runs scenes whose motion is known in closed form with each solver.
#include <memory>

#include <nlohmann/json.hpp>

#include "compare/problem/error.hpp"
#include "experiments/program/commands.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/progress.hpp"
#include "experiments/program/runs/laws.hpp"
#include "fast/contestant.hpp"

namespace ogc::experiments {

namespace {

struct LawsOptions {
  std::vector<std::string> laws;
  std::string solver, backend, bounds;
  bool quick = false, list = false, schema = false;
};

void check(const LawsOptions& options) {
  if (!options.backend.empty() && !options.solver.empty() && options.solver != "vbd")
    throw compare::InputError("--backend belongs to --solver vbd; " + options.solver + " runs on the CPU");
  if (!options.bounds.empty() && options.solver == "ipc")
    throw compare::InputError("--bounds: ipc has bounds of its own, by continuous detection; leave it out");
  if (options.backend != "cuda") return;
  const fast::BackendInfo device = fast::backend_info(fast::Backend::cuda);
  if (!device.usable) throw compare::ResourceError("--backend cuda: " + device.description);
}

/// Returns the solvers and bounds that the options select. Without options: vbd on the CPU with balls and with planes,
/// newton, ipc. --backend selects vbd alone. If no bounds are named, newton runs with balls only, because bounds change
/// its iterates but not the resulting motion.
std::vector<LawAsked> asked_by(const LawsOptions& options) {
  check(options);
  const auto is_asked = [&](const char* solver) {
    return options.solver == solver || (options.solver.empty() && options.backend.empty());
  };
  std::vector<compare::Bounds> bounds{compare::Bounds::ball, compare::Bounds::planes};
  if (options.bounds == "ball") bounds.pop_back();
  if (options.bounds == "planes") bounds.erase(bounds.begin());
  std::vector<LawAsked> asked;
  if (is_asked("vbd") || !options.backend.empty())
    for (const compare::Bounds kind : bounds) asked.push_back({Solver::vbd, options.backend == "cuda", kind});
  if (is_asked("newton")) asked.push_back({Solver::newton, false, bounds[0]});
  if (is_asked("ipc") && options.bounds.empty()) asked.push_back({Solver::ipc, false, compare::Bounds::ball});
  return asked;
}

std::vector<const compare::Law*> chosen(const std::vector<std::string>& names) {
  std::vector<const compare::Law*> found;
  for (const std::string& name : names) found.push_back(&compare::find_law(name));
  if (names.empty())
    for (const compare::Law& law : compare::laws()) found.push_back(&law);
  return found;
}

void run_laws(const LawsOptions& options, CommandContext& context) {
  if (options.schema) return print_result(laws_schema());
  if (options.list) return print_result(list_laws());
  const std::vector<const compare::Law*> laws = chosen(options.laws);
  const std::vector<LawAsked> asked = asked_by(options);
  const compare::LawSize size = options.quick ? compare::LawSize::least : compare::LawSize::whole;
  const auto total = static_cast<std::int64_t>(laws.size() * asked.size());
  std::vector<LawRow> rows;
  Progress progress(0, total, "row");
  for (const compare::Law* law : laws)
    for (const LawAsked& who : asked) {
      progress.show(static_cast<std::int64_t>(rows.size()), std::string(law->name));
      rows.push_back(ask(*law, size, who));
    }
  progress.show(total, "all asked");
  progress.end();
  if (any_broken(rows)) context.status = exit_check_failed;
  if (context.json) return print_result(law_json(rows, size));
  print_result(describe(rows));
}

}  // namespace

void add_laws_command(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<LawsOptions>();
  CLI::App* command = app.add_subcommand("laws", "Closed answers (falls, slopes, beams …) asked of each solver");
  command->add_option("LAW", options->laws, "Names of laws (default: all laws of --list)");
  command
      ->add_option("--solver", options->solver,
                   "This solver is asked: This solver is asked: vbd, newton or ipc (default: each of them)")
      ->check(CLI::IsMember({"vbd", "newton", "ipc"}));
  command->add_option("--backend", options->backend, "vbd runs on cpu or cuda (default: cpu)")
      ->check(CLI::IsMember({"cpu", "cuda"}));
  command
      ->add_option("--bounds", options->bounds,
                   "Vertices have this bound: ball or planes (default: vbd is asked with both, newton with ball)")
      ->check(CLI::IsMember({"ball", "planes"}));
  command->add_flag("--quick", options->quick, "Each law is asked at its least size, as CI does");
  command->add_flag("--list", options->list, "List the laws with what they prove and their answers");
  command->add_flag("--schema", options->schema, "Print the JSON Schema of --json");
  command->add_flag("--json", context.json, "Print every reading of every row as JSON on standard output");
  command->footer(
      "A law is a small scene whose motion is known in closed form. Each row holds the worst of a law's readings "
      "beside\n"
      "what the law says and how far it may be off; a row that is beyond its tolerance within a derived limit of the\n"
      "method says so. Exit status 1 where a law is broken. The laws, with derivations: compare/laws.md.\n\n"
      "Examples:\n"
      "  ogc laws --quick\n"
      "  ogc laws slope_slides --solver vbd --bounds planes\n"
      "  ogc laws free_fall spin --solver newton --json");
  command->callback([options, &context] { run_laws(*options, context); });
}

}  // namespace ogc::experiments
