// `ogc run`: options to a RunRequest, and the result to an exit status.
#include <map>

#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include "compare/files/scene_files.hpp"
#include "compare/problem/error.hpp"
#include "experiments/commands.hpp"
#include "experiments/interrupt.hpp"
#include "experiments/run_session.hpp"
#include "experiments/scenes/registry.hpp"
#include "fast/contestant.hpp"

namespace ogc::experiments {

namespace {

struct Options {
  std::string scene, solver = "vbd", backend = "cpu", scale, audit = "frame", from_state, out;
  std::vector<std::string> assignments;
  std::int64_t steps = 0;
  bool profile = false;
  int threads = 0;
};

std::string settings_help() {
  std::vector<std::vector<std::string>> rows{{"  setting", "unit", "default", "range", "meaning"}};
  const compare::Settings defaults;
  for (const compare::SettingInfo& info : compare::setting_table())
    rows.push_back({"  " + std::string(info.name), std::string(info.unit), number(compare::get_setting(defaults, info.name)),
                    number(info.minimum) + " … " + number(info.maximum), std::string(info.meaning)});
  return "Settings for --set (a scene brings its own values; defaults are those of a scene file that says nothing):\n" + table(rows, 5);
}

std::string scene_names() {
  std::string names;
  for (const SceneInfo& info : scenes()) names += (names.empty() ? "" : ", ") + std::string(info.name);
  return names;
}

bool is_scene_file(const std::string& scene) { return scene.ends_with(".json"); }

compare::Scene load_scene(const Options& options, std::string& scale) {
  if (is_scene_file(options.scene)) {
    if (!options.scale.empty()) throw compare::InputError("--scale belongs to the built-in scenes (" + scene_names() + "); a scene file has one size");
    return compare::read_scene(options.scene);
  }
  scale = options.scale.empty() ? "small" : options.scale;
  return make_scene(options.scene, parse_scale(scale));
}

void apply_settings(compare::Settings& settings, const Options& options) {
  for (const std::string& assignment : options.assignments) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0)
      throw compare::InputError("--set " + assignment + ": give key=value, for example --set iterations=20");
    compare::set_setting(settings, assignment.substr(0, equals), assignment.substr(equals + 1));
  }
  if (options.steps > 0) compare::set_setting(settings, "steps", std::to_string(options.steps));
}

RunRequest request_of(const Options& options, const CommandContext& context) {
  if (options.solver != "vbd")
    throw compare::InputError("--solver " + options.solver + " does not exist yet; there is: vbd (Vertex Block Descent with OGC contact)");
  RunRequest request;
  request.scene = load_scene(options, request.scale);
  apply_settings(request.scene.settings, options);
  request.backend = options.backend;
  request.audit_beside = options.backend == "cuda";
  const std::map<std::string, AuditMode> modes{
      {"every", AuditMode::every}, {"frame", AuditMode::frame}, {"end", AuditMode::end}, {"off", AuditMode::off}};
  request.audit = modes.at(options.audit);
  if (!options.from_state.empty()) request.from_state = options.from_state;
  request.profile = options.profile;
  const std::string scale = request.scale.empty() ? "" : "-" + request.scale;
  request.folder = options.out.empty() ? "runs/" + request.scene.name + scale + "-" + utc_stamp() : options.out;
  request.command_line = context.command_line;
  return request;
}

std::string introduction(const RunRequest& request) {
  const compare::Scene& scene = request.scene;
  return scene.name + (request.scale.empty() ? "" : " (" + request.scale + ")") + ": " + std::to_string(scene.mesh.positions.size()) + " vertices, " +
         counted(scene.mesh.triangles.size(), "triangle") + ", " + std::to_string(scene.settings.steps) + " steps of " +
         number(scene.settings.time_step) + " s; writes " + request.folder.string();
}

int run(const Options& options, const CommandContext& context) {
  std::optional<tbb::global_control> limit;
  if (options.threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
  RunRequest request = request_of(options, context);
  catch_interrupts();
  const std::string text = introduction(request);
  RunSession session(std::move(request), fast::contestant(options.backend == "cuda" ? fast::Backend::cuda : fast::Backend::cpu));
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
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("run", "Simulate a scene into a run folder, audited exactly");
  command->add_option("SCENE|FILE.json", options->scene, "A built-in scene (" + scene_names() + ") or a scene file")->required();
  command->add_option("--solver", options->solver, "How a step is solved")->check(CLI::IsMember({"vbd", "newton", "ipc", "penalty"}))->capture_default_str();
  command->add_option("--backend", options->backend, "Where it is computed")->check(CLI::IsMember({"cpu", "cuda"}))->capture_default_str();
  command->add_option("--scale", options->scale, "smoke (seconds), small (minutes on 2 cores; default), paper (the paper's sizes)");
  command->add_option("--steps", options->steps, "Number of the last step (default: the scene's)")->check(CLI::PositiveNumber);
  command->add_option("--set", options->assignments, "key=value, repeatable; the settings are listed below")->take_all()->type_size(1)->expected(1);
  command->add_option("--audit", options->audit,
                      "Which states are judged: each step, stored frames, the last one, none")
      ->check(CLI::IsMember({"every", "frame", "end", "off"}))->capture_default_str();
  command->add_option("--from-state", options->from_state, "Start from a frame file of a run (RUN/frames/…) instead of the scene's start");
  command->add_flag("--profile", options->profile, "Record the time of each stage (slows the run down a little)");
  command->add_option("--out", options->out, "Run folder (default: runs/SCENE-SCALE-TIME)");
  command->add_option("--threads", options->threads, "Threads of the CPU (default: all); changes no bit of the result")->check(CLI::PositiveNumber);
  command->add_flag("--json", context.json, "Print the summary as JSON on standard output");
  command->footer(settings_help() +
                  "\nExamples:\n"
                  "  ogc run cloth_on_sphere --scale smoke\n"
                  "  ogc run twist --backend cuda --scale paper --steps 1200 --audit every\n"
                  "  ogc scenes twist --write mine && ogc run mine/twist.json --set iterations=20 --set contact_radius=0.003\n\n"
                  "An audit is exact: no edge meets a triangle, no vertex moved beyond its bound, no bound is larger than the exact one. On the CPU it takes\n"
                  "turns with the simulation, on a GPU it runs beside it, so that it is never part of a step's time.\n"
                  "Ctrl-C stops after the current frame; what is finished stays. Exit status 1: a penetration, a broken bound, a number that is not finite.");
  command->callback([options, &context] { context.status = run(*options, context); });
}

}  // namespace ogc::experiments
