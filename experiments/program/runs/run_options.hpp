// Declares the options of a run. `ogc run` uses them once, `ogc ablate` once for each point of its grid.
#pragma once

#include <memory>
#include <optional>

#include "experiments/program/commands.hpp"
#include "experiments/program/mesh_input.hpp"
#include "experiments/program/runs/run_session.hpp"

namespace ogc::experiments {

/// Holds the options as typed.
struct RunOptions {
  /// the options of these names
  std::string scene, solver = "vbd", backend = "cpu", scale, audit = "frame", audit_meetings, from_state, out, show;
  std::vector<std::string> assignments;  ///< "key=value" of --set, applied in order
  std::int64_t steps = 0;                ///< 0: the steps of the scene
  /// the options of these names
  bool profile = false, iterations = false, condition = false, residual = false, ledger = false;
  bool tolerate_start = false;                             ///< --tolerate-start
  Jitter jitter;                                           ///< --jitter and --seed
  compare::MeshOptions mesh;                               ///< how a mesh file in place of a scene is read
  std::optional<double> ground;                            ///< height of the ground below that mesh [m]
  std::optional<double> deepest;                           ///< --deepest [m]
  int threads = 0;                                         ///< 0: all
  double checkpoint_seconds = default_checkpoint_seconds;  ///< least time between two checkpoints [s]
};

/// Adds all options except --threads. Returns the scene's option, which is required.
CLI::Option* add_run_options(CLI::App& command, const std::shared_ptr<RunOptions>& options);

/// Returns the names of the built-in scenes, separated by commas.
std::string scene_names();
/// Returns the table of settings for the help text.
std::string settings_help();

/// Returns the folder of the last "data=DIR" of --set, empty if there is none. It is a property of a scene, not a
/// setting.
std::string data_folder(const std::vector<std::string>& assignments);

/// Returns the request of these options. Throws compare::InputError that says what to give instead.
RunRequest request_of(const RunOptions& options, const CommandContext& context);
/// Returns the contestant that computes the run. `meetings`: those of the request.
compare::Contestant contestant_of(const RunOptions& options, const std::optional<StepRange>& meetings);

}  // namespace ogc::experiments
