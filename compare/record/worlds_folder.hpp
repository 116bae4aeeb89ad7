// Writes the folder of a run of many worlds: scenes of one mesh that run side by side and never see each other.
//
//   run.json           as for a run of one world, with "worlds" and what they have in common
//   scene/NAME.json    the scene
//   worlds.csv         one row for each world: its seed, its own settings (set_friction), how it ended, its totals;
//                      written when the run ends
//   worlds_steps.csv   the columns of steps.csv (compare/record/steps_csv.hpp) behind the number of the world; grows
//   ends/world_0003.h5 the last good state of world 3 (compare/record/frame_file.hpp); `ogc run --from-state` begins
//                      there
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/files/durable_file.hpp"
#include "compare/record/frame_file.hpp"
#include "compare/record/manifest.hpp"
#include "compare/record/steps_csv.hpp"

namespace ogc::compare {

/// A row of worlds.csv.
struct WorldRow {
  int world = 0;                  ///< number, from 0
  std::uint64_t jitter_seed = 0;  ///< seed of its offsets; 0: it has none
  /// names and values of the settings that it has of its own, the same names in all rows; empty values: the scene's
  std::vector<std::pair<std::string, std::string>> settings{};
  std::string status;                                        ///< "finished", "interrupted" or "failed"
  std::string failure;                                       ///< first line of the failure; empty if there is none
  std::int64_t last_step = 0;                                ///< step of the last good state
  std::int64_t detections = 0, iterations = 0, repeats = 0;  ///< sums over the steps
  std::int64_t vertex_facet_contacts = 0, edge_edge_contacts = 0;        ///< of the last step
  double smallest_distance = 0, largest_lag = 0, largest_share_cut = 0;  ///< extremes over the steps [m], [m], [1]
  double kinetic_energy = 0, elastic_energy = 0, contact_energy = 0, gravity_energy = 0;  ///< after the last step [J]
  std::size_t audited_states = 0;  ///< states whose audit found nothing
  std::string final_hash;          ///< hash of the last good positions
};

/// Writes the folder of worlds. Throws ResourceError with the path if the disk is full or not writable.
class WorldsWriter {
 public:
  /// Creates the folder and run.json with status "running". Throws InputError if the folder already has a run.
  WorldsWriter(std::filesystem::path folder, const Scene& scene, const Provenance& provenance);
  /// Appends rows of a world.
  void add_steps(int world, const std::vector<StepMetrics>& rows);
  /// Sets an entry of Provenance::extra, which the final run.json contains.
  void set_extra(const std::string& key, const std::string& value) { manifest_.provenance.extra[key] = value; }
  /// Writes the last state of each world, worlds.csv and the final run.json.
  void finish(const std::vector<WorldRow>& rows, const std::vector<Frame>& ends, const std::string& status);
  /// Writes run.json with a failure that ended all worlds.
  void give_up(const std::string& status);

 private:
  std::filesystem::path folder_;
  Scene scene_;
  Manifest manifest_;
  std::optional<LineAppender> steps_;
};

}  // namespace ogc::compare
