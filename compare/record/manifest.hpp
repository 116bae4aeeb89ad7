// run.json: who ran what, where and when, and with which numbers. For people and plots; the program itself reads the
// scene back from its own files.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// The newest run folder that this program writes and reads. Of format 1, with other names of two columns of rows, it
/// reads, too (StepColumn::former_name).
inline constexpr int run_format_version = 2;

/// What run.json says besides the scene: who ran what, where, when.
struct Provenance {
  std::string solver, backend, device, command;  ///< as the user named them, and where it ran
  std::string version, commit, compiler, cuda;   ///< of the program
  bool dirty = false;                            ///< whether the tree had changes beyond the commit
  std::string started, ended, status;            ///< ISO 8601, UTC; status: "running", "finished", "failed: …"
  std::vector<std::string> warnings;             ///< about settings that are hardly meant
  Vec3 origin{};  ///< what positions are relative to, in the coordinates of the mesh's file [m]; exports add it
  std::map<std::string, std::string> extra;  ///< further entries of run.json; "yes" and "no" are truth values there
};

/// What run.json says beside the copy of the scene's numbers.
struct Manifest {
  Provenance provenance;                 ///< who ran it, and with what
  std::string scene_name, scene_file;    ///< file: relative to the run folder
  std::vector<std::string> stage_names;  ///< of steps.csv
};

/// The text of run.json: `manifest`, and of the scene its sizes, settings and bodies with each number's unit.
std::string manifest_text(const Manifest& manifest, const Scene& scene);

/// Reads `folder`/run.json. Throws InputError that names the file: missing, not JSON, not of a run, or of a newer
/// format, which is named.
Manifest read_manifest(const std::filesystem::path& folder);

/// Date and time now, ISO 8601, UTC, whole seconds.
std::string utc_now();

}  // namespace ogc::compare
