// Declares the options of a run. `ogc run` uses them once, `ogc ablate` once for each point of its grid.
#pragma once

#include <memory>
#include <optional>

#include "experiments/program/commands.hpp"
#include "experiments/program/mesh_input.hpp"
#include "experiments/program/runs/run_session.hpp"

namespace ogc::experiments {

/// Holds the options as given on the command line.
struct RunOptions {
  std::string scene, solver = "vbd", backend = "cpu", scale, audit = "frame", audit_meetings, from_state, out, show;
  std::vector<std::string> assignments;  ///< "key=value" of each --set, applied in order
  std::int64_t steps = 0;                ///< 0: as many steps as the scene has
  bool profile = false, iterations = false, condition = false, residual = false, ledger = false;
  std::int64_t repeats = 0;  ///< repetitions of each step for its times; 0: its first time counts
  bool tolerate_start = false;
  Jitter jitter;
  compare::MeshOptions mesh;                               ///< how a mesh file is read, if it replaces a scene
  std::optional<double> ground;                            ///< y of the ground below the mesh of a mesh file [m]
  std::optional<double> deepest;                           ///< --deepest [m]
  int worlds = 0;                                          ///< number of worlds; 0: one run
  int devices = 1;                                         ///< CUDA devices that divide the run
  std::string world_settings;                              ///< table of settings by world; empty: none
  int threads = 0;                                         ///< number of CPU threads; 0: all
  double checkpoint_seconds = default_checkpoint_seconds;  ///< least time between two checkpoints [s]
};

/// Adds all options except --threads. Returns the scene's option, which is required.
CLI::Option* add_run_options(CLI::App& command, const std::shared_ptr<RunOptions>& options);

/// Returns the names of the built-in scenes, separated by commas.
std::string scene_names();
/// Returns the table of settings for the help text.
std::string settings_help();

/// Throws compare::InputError if --set has no key of this name.
void expect_setting(const std::string& key);
/// Sets a value that --set accepts, except data and body_contact, which make the scene. Throws compare::InputError for
/// an unknown key, and for a value that is not valid.
void set_in_scene(compare::Scene& scene, const std::string& key, const std::string& value);

/// Returns the folder of the last "data=DIR" among the assignments; empty if there is none. "data" is a property of the
/// scene, not a setting.
std::string data_folder(const std::vector<std::string>& assignments);

/// Returns the run that these options request. Throws compare::InputError with a remedy if an option is not valid.
RunRequest request_of(const RunOptions& options, const CommandContext& context);
/// Returns the contestant that computes the run. `meetings`: steps of the request whose meetings are counted.
compare::Contestant contestant_of(const RunOptions& options, const std::optional<StepRange>& meetings);

}  // namespace ogc::experiments
