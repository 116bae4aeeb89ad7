// Reads the table of settings by world (`ogc run --world-settings`): the first line names settings, each other line has
// the values of one world. An empty value keeps that of the scene.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "experiments/program/runs/run_session.hpp"

namespace ogc::experiments {

/// One world.
struct World {
  compare::Scene scene{};         ///< with its own settings; empty if it has none
  std::uint64_t jitter_seed = 0;  ///< seed of its offsets, if the run has a jitter
  std::string name{};             ///< "world 3", or "world 3 (FILE, line 5)"
  /// names and values of the table's settings, by column; empty if there are none
  std::vector<std::pair<std::string, std::string>> settings{};
};

/// Returns `count` worlds without settings of their own, whose seeds are the request's, + 1, + 2, ….
std::vector<World> equal_worlds(const RunRequest& request, std::size_t count);

/// Returns a world for each line of the table `file`, which has the settings of the request's scene but for those of
/// its line. Column jitter_seed is the seed of the world's offsets; a world without one has the request's seed + its
/// number. Throws compare::InputError that names the file, and line and column if they are at fault: for a column that
/// is no setting, occurs twice, or says what all worlds share; for a value that the setting refuses; for a line with
/// another number of values; for a table without a line; if `count` is neither 0 nor the number of lines.
std::vector<World> read_worlds(const std::filesystem::path& file, const RunRequest& request, std::size_t count);

}  // namespace ogc::experiments
