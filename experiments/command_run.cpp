// `ogc run`: options to a RunRequest, and the result to an exit status.
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include "experiments/commands.hpp"
#include "experiments/interrupt.hpp"
#include "experiments/run_options.hpp"

namespace ogc::experiments {

namespace {

std::string introduction(const RunRequest& request) {
  const compare::Scene& scene = request.scene;
  return scene.name + (request.scale.empty() ? "" : " (" + request.scale + ")") + ": " + std::to_string(scene.mesh.positions.size()) + " vertices, " +
         counted(scene.mesh.triangles.size(), "triangle") + ", " + std::to_string(scene.settings.steps) + " steps of " +
         number(scene.settings.time_step) + " s; writes " + request.folder.string();
}

int run(const RunOptions& options, const CommandContext& context) {
  std::optional<tbb::global_control> limit;
  if (options.threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
  RunRequest request = request_of(options, context);
  catch_interrupts();
  const std::string text = introduction(request);
  RunSession session(std::move(request), contestant_of(options));
  log_line(text);
  const RunSummary summary = session.run();
  if (context.json) {
    print_result(to_json(summary));
  } else {
    print_result(describe(summary));
  }
  if (!summary.failure.empty()) log_line("ogc: " + summary.failure);
  if (!summary.failure.empty()) return exit_check_failed;
  return summary.was_interrupted ? exit_interrupted : static_cast<int>(exit_success);
}

}  // namespace

void add_run_command(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", "Simulate a scene into a run folder, audited exactly");
  add_run_options(*command, options);
  command->add_option("--threads", options->threads, "Threads of the CPU (default: all); changes no bit of the result")->check(CLI::PositiveNumber);
  command->add_flag("--json", context.json, "Print the summary as JSON on standard output");
  command->footer(settings_help() +
                  "\nExamples:\n"
                  "  ogc run cloth_on_sphere --scale smoke\n"
                  "  ogc run cloth_on_sphere --scale small --solver newton --set newton_tolerance=1e-3 --iterations\n"
                  "  ogc run cloth_on_sphere --scale smoke --iterations --profile --steps 12\n"
                  "  ogc run twist --backend cuda --scale paper --steps 1200 --audit every\n"
                  "  ogc scenes twist --write mine && ogc run mine/twist.json --set iterations=20 --set contact_radius=0.003\n\n"
                  "An audit is exact: no edge meets a triangle, no vertex moved beyond its bound, no bound is larger than the exact one. On the CPU it takes\n"
                  "turns with the simulation, on a GPU it runs beside it, so that it is never part of a step's time.\n"
                  "Ctrl-C stops after the current frame; what is finished stays. Exit status 1: a penetration, a broken bound, a number that is not finite.");
  command->callback([options, &context] { context.status = run(*options, context); });
}

}  // namespace ogc::experiments
