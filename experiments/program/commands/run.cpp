// `ogc run`: turns options into a RunRequest, and the result into an exit status.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>

#include <nlohmann/json.hpp>

#include "compare/problem/error.hpp"
#include "experiments/program/commands.hpp"
#include "experiments/program/interrupt.hpp"
#include "experiments/program/option_checks.hpp"
#include "experiments/program/python_program.hpp"
#include "experiments/program/runs/resume.hpp"
#include "experiments/program/runs/sheet.hpp"
#include "experiments/program/runs/worlds_run.hpp"

namespace ogc::experiments {

namespace {

std::string introduction(const RunRequest& request) {
  const compare::Scene& scene = request.scene;
  return scene.name + (request.scale.empty() ? "" : " (" + request.scale + ")") + ": " +
         std::to_string(scene.mesh.positions.size()) + " vertices, " +
         counted(scene.mesh.triangles.size(), "triangle") + ", " + std::to_string(scene.settings.steps) + " steps of " +
         number(scene.settings.time_step) + " s; writes " + request.folder.string();
}

/// RunOptions that are allowed with --resume, because they change no bit of the results.
constexpr std::array<std::string_view, 7> free_options{"--resume", "--threads", "--devices", "--checkpoint",
                                                       "--json",   "--view",    "--view-png"};

ResumedRun resumed(const RunOptions& options, const std::string& folder, const CLI::App& command) {
  std::string given;
  for (const CLI::Option* option : command.get_options())
    if (option->count() > 0 && std::ranges::find(free_options, option->get_name()) == free_options.end())
      given += (given.empty() ? "" : ", ") + option->get_name();
  if (!given.empty())
    throw compare::InputError(
        "--resume " + folder +
        " goes on with the scene, settings and options that the folder holds, and with no other; leave out: " + given +
        ". For other ones begin a new run, from a frame of this one with --from-state if you like");
  ResumedRun run = resumed_run(folder);
  run.request.checkpoint_seconds = options.checkpoint_seconds;
  run.options.devices = options.devices;
  return run;
}

int make_worlds(const RunOptions& options, const CommandContext& context) {
  RunRequest request = request_of(options, context);
  check_worlds(request);
  const auto count = static_cast<std::size_t>(options.worlds);
  std::vector<World> worlds = options.world_settings.empty() ? equal_worlds(request, count)
                                                             : read_worlds(options.world_settings, request, count);
  catch_interrupts();
  log_line(std::to_string(worlds.size()) + " times " + introduction(request));
  const WorldsSummary summary = run_worlds(std::move(request), std::move(worlds));
  if (context.json) {
    print_result(to_json(summary));
  } else {
    print_result(describe(summary));
  }
  if (summary.failed > 0) return exit_check_failed;
  return summary.was_interrupted ? exit_interrupted : static_cast<int>(exit_success);
}

/// How a run is shown while it goes on: in a window, in a picture, or not at all.
struct LiveView {
  bool window = false;
  std::string png;
  bool any() const { return window || !png.empty(); }
  std::vector<std::string> words(const std::string& target) const {
    std::vector<std::string> result{target, "--follow"};
    if (!png.empty()) result.insert(result.end(), {"--png", png});
    return result;
  }
};

/// Starts the viewer, which follows the run's folder: the run never waits for a picture.
void start_view(const LiveView& view, const std::filesystem::path& folder, const compare::Mesh& mesh) {
  ScratchFolder sheet;
  write_run_sheet(sheet.path(), folder, mesh);
  std::vector<std::string> words = view.words(sheet.path().string());
  words.insert(words.end(), {"--process", std::to_string(getpid())});
  start_python("plots.view", words);
  sheet.release();
}

int make_run(const RunOptions& options, const std::string& resume, const LiveView& view, const CLI::App& command,
             const CommandContext& context) {
  const auto limit = limited_threads(options.threads);
  if (options.scene.empty() && resume.empty())
    throw compare::InputError("run needs a scene (" + scene_names() +
                              "), a scene file, a mesh file, or --resume RUN; see ogc run --help");
  if (resume.empty() && (options.worlds > 0 || !options.world_settings.empty())) {
    if (view.any())
      throw compare::InputError("--view shows a run of one world; leave it out, or --worlds and --world-settings");
    if (options.devices > 1) throw compare::InputError("worlds run on one device; leave them or --devices out");
    return make_worlds(options, context);
  }
  ResumedRun run = resume.empty() ? ResumedRun{options, request_of(options, context)}
                                  : resumed(options, resume, command);
  const std::filesystem::path folder = run.request.folder;
  if (view.any()) {
    std::vector<std::string> check = view.words(folder.string());
    check.emplace_back("--check");
    if (const int status = run_python("plots.view", check); status != 0) return status;
  }
  const compare::Mesh mesh = view.any() ? run.request.scene.mesh : compare::Mesh{};
  catch_interrupts();
  const std::string text = introduction(run.request);
  compare::Contestant contestant = contestant_of(run.options, run.request.meetings);
  RunSession session(std::move(run.request), std::move(contestant));
  log_line(text);
  if (view.any()) start_view(view, folder, mesh);
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
  add_run_options(*command, options)->required(false);
  auto resume = std::make_shared<std::string>();
  command->add_option(
      "--resume", *resume,
      "The run in this folder, which was cut off, goes on to the same bits; --resume takes no scene and no settings");
  command
      ->add_option("--worlds", options->worlds,
                   "So many copies run side by side and never see each other; with --jitter, copy w begins with the "
                   "offsets of seed + w. A copy that fails is named, and the others go on")
      ->check(whole_number(1, most_worlds));
  command
      ->add_option("--devices", options->devices,
                   "So many CUDA devices of this machine divide the run (cloth and solids, bounds=ball), with the same "
                   "bits as one; worthwhile from some 100,000 vertices on")
      ->check(whole_number(1, most_devices));
  command->add_option("--world-settings", options->world_settings,
                      "The lines of this table (CSV) are worlds, as many as there are lines. Its first line names "
                      "settings of --set; a value of a line belongs to its world alone, and an empty one is the "
                      "scene's. A world with fewer steps ends before the others. Column jitter_seed is its seed for "
                      "--jitter. data, body_contact and frame_steps are common to all worlds");
  add_threads_option(*command, options->threads);
  auto view = std::make_shared<LiveView>();
  command->add_flag(
      "--view", view->window,
      "A window shows the newest frame while the run goes on (ogc view --help); the run never waits for it");
  command->add_option("--view-png", view->png, "This file gets a picture of the newest frame again and again")
      ->excludes("--view");
  command->add_flag("--json", context.json, "Print the summary as JSON on standard output");
  command->footer(
      settings_help() +
      "\nExamples:\n"
      "  ogc run cloth_on_sphere --scale smoke\n"
      "  ogc run cloth_on_sphere --scale small --solver newton --set newton_tolerance=1e-3 --iterations\n"
      "  ogc run cloth_on_sphere --scale smoke --iterations --profile --steps 12\n"
      "  ogc run twist --backend cuda --scale paper --steps 1200 --audit every\n"
      "  ogc run shirt.obj --ground 0 --steps 200\n"
      "  ogc run knot --scale smoke --jitter 1e-6 --seed 7   # and 8, 9, …: what do they have in common?\n"
      "  ogc run cloth_on_sphere --scale smoke --backend cuda --worlds 256 --jitter 1e-6   # copies side by side\n"
      "  ogc run twist --scale smoke --world-settings worlds.csv   # friction,steps / 0.1,60 / 0.5,90 are two worlds\n"
      "  ogc run --resume runs/twist-paper-20250801-120000\n"
      "  ogc scenes twist --write mine && ogc run mine/twist.json --set iterations=20 --set contact_radius=0.003\n\n"
      "An audit is exact: no edge meets a triangle, no vertex moved beyond its bound, no bound is larger than the "
      "exact one. On the CPU it takes\n"
      "turns with the simulation, on a GPU it runs beside it, so that it is never part of a step's time.\n"
      "Ctrl-C stops within a second, or after the step that is computed. What is finished stays, whatever\n"
      "ends the run: a signal, kill -9, a full disk, power. --resume goes on from checkpoint.h5 (every\n"
      "--checkpoint seconds, and at each end that leaves time for it), which the same program and scene take\n"
      "to the very bits of a run that was never cut off: frames, rows of steps.csv (but for times), final\n"
      "state; so do all solvers, IPC, too. What it refuses (another program, device or scene, damage, a\n"
      "run that still goes on) it says before it computes anything.\n"
      "A scene larger than 20 m, r above two median edges, isometric bending on a rest shape that is not flat, a\n"
      "tolerance of IPC above what gravity changes in a step, a lag above r, and a step of which truncation takes\n"
      "more than half are warned of once, with number and remedy: as they happen, in the last line, in --json and\n"
      "in run.json.\n"
      "Frames are packed and written beside the simulation, which waits where the disk is too slow. The\n"
      "summary and run.json say where the time went: start, steps, waiting for audits, for the disk.\n"
      "Exit status 1: a penetration, a broken bound, a number that is not finite.");
  command->callback([options, resume, view, command, &context] {
    context.status = make_run(*options, *resume, *view, *command, context);
  });
}

}  // namespace ogc::experiments
