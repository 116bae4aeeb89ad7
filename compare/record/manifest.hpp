// Writes and reads run.json: the solver, device, command and time of a run, and its numbers. It is for people and
// plots; the program itself reads the scene back from its own files.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// Newest version of run folders that this program writes and reads. It also reads format 1, in which two columns have
/// other names (StepColumn::former_name).
inline constexpr int run_format_version = 2;

/// Holds the solver, device, program and times of a run, which run.json has besides the scene.
struct Provenance {
  std::string solver, backend, device, command;  ///< names given by the user, and the device that it ran on
  std::string version, commit, compiler, cuda;   ///< of the program
  bool dirty = false;                            ///< whether the tree had changes beyond the commit
  std::string started, ended, status;            ///< ISO 8601, UTC; status: "running", "finished", "failed: …"
  std::vector<std::string> warnings;             ///< about settings that are probably a mistake
  Vec3 origin{};  ///< point that positions are relative to, in the coordinates of the mesh's file [m]; exports add it
  std::map<std::string, std::string> extra;  ///< further entries of run.json; "yes" and "no" become truth values there
};

/// Holds the contents of run.json except the copy of the scene's numbers.
struct Manifest {
  Provenance provenance;                 ///< solver, program, device and times
  std::string scene_name, scene_file;    ///< scene_file: path relative to the run folder
  std::vector<std::string> stage_names;  ///< stages with columns in steps.csv
};

/// Returns the text of run.json: `manifest`, and the scene's sizes, settings and bodies with each number's unit.
std::string manifest_text(const Manifest& manifest, const Scene& scene);

/// Reads `folder`/run.json. Throws InputError that names the file if it is missing, not JSON, not of a run, or of a
/// newer format; the message names the format.
Manifest read_manifest(const std::filesystem::path& folder);

/// Returns the current date and time, ISO 8601, UTC, whole seconds.
std::string utc_now();

}  // namespace ogc::compare
