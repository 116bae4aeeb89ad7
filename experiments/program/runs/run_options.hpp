// The options of a run: `ogc run` takes them once, `ogc ablate` once for each point of its grid.
#pragma once

#include <memory>
#include <optional>

#include "experiments/program/commands.hpp"
#include "experiments/program/mesh_input.hpp"
#include "experiments/program/runs/run_session.hpp"

namespace ogc::experiments {

/// The options as typed.
struct RunOptions {
  /// as of the options with these names
  std::string scene, solver = "vbd", backend = "cpu", scale, audit = "frame", audit_meetings, from_state, out, show;
  std::vector<std::string> assignments;  ///< "key=value" of --set, applied in order
  std::int64_t steps = 0;                ///< 0: the scene's
  /// likewise
  bool profile = false, iterations = false, condition = false, residual = false, ledger = false;
  bool tolerate_start = false;                             ///< of --tolerate-start
  Jitter jitter;                                           ///< of --jitter and --seed
  compare::MeshOptions mesh;                               ///< of a mesh file in place of a scene
  std::optional<double> ground;                            ///< height of the ground below it [m]
  std::optional<double> deepest;                           ///< of --deepest [m]
  int threads = 0;                                         ///< 0: all
  double checkpoint_seconds = default_checkpoint_seconds;  ///< between two checkpoints, at least [s]
};

/// Adds all of them but --threads. Returns the scene, which is required.
CLI::Option* add_run_options(CLI::App& command, const std::shared_ptr<RunOptions>& options);

/// Names of the built-in scenes, separated by commas.
std::string scene_names();
/// The table of settings, for help.
std::string settings_help();

/// The folder that the last "data=DIR" of --set names, empty where there is none; a property of a scene and no setting.
std::string data_folder(const std::vector<std::string>& assignments);

/// Throws compare::InputError that says what to give instead.
RunRequest request_of(const RunOptions& options, const CommandContext& context);
/// Who computes it; `meetings`: of the request.
compare::Contestant contestant_of(const RunOptions& options, const std::optional<StepRange>& meetings);

}  // namespace ogc::experiments
