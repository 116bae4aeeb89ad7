// Runs worlds of one mesh side by side (`ogc run --worlds`), with settings, starts and ends of their own
// (world_settings.hpp). A world that fails stops at its last good state and is named; the others go on.
#pragma once

#include <string>
#include <vector>

#include "compare/record/worlds_folder.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/runs/run_session.hpp"
#include "experiments/program/runs/world_settings.hpp"

namespace ogc::experiments {

/// Holds the result of a run of worlds.
struct WorldsSummary {
  std::string scene, scale, backend, device, folder, status;  ///< values of run.json
  std::vector<compare::WorldRow> worlds;                      ///< by world
  std::size_t failed = 0;                                     ///< worlds that failed
  std::int64_t steps = 0;                                     ///< steps of the world that did most
  double megabytes = 0;                                       ///< memory of all worlds at the start [MB]
  double step_ms = 0;                                         ///< median time of a step of all worlds together [ms]
  double whole_seconds = 0, start_seconds = 0, step_seconds = 0, audit_seconds = 0;  ///< [s]
  std::size_t audited_states = 0;                                                    ///< states that were audited
  bool was_interrupted = false;
};

/// Throws compare::InputError, which names the option, if the request asks for what worlds do not have.
void check_worlds(const RunRequest& request);

/// Runs worlds and writes their folder. Throws as RunSession does, and compare::ResourceError if the worlds do not fit
/// into the memory of the device.
WorldsSummary run_worlds(RunRequest request, std::vector<World> worlds);

/// Returns the summary as JSON.
Json to_json(const WorldsSummary& summary);
/// Returns the summary as text, with a line for each world that failed.
std::string describe(const WorldsSummary& summary);

}  // namespace ogc::experiments
