// Run folders (design.md §5): run.json, steps.csv, frames/, trajectory.vtkhdf. A run that is killed at any time leaves all of its finished frames
// readable: every file is written under a temporary name, synced and renamed; steps.csv grows by whole lines.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "compare/problem/contestant.hpp"

namespace ogc::compare {

/// What run.json says besides the scene: who ran what, where, when.
struct Provenance {
  std::string solver, backend, device, command;
  std::string version, commit, compiler, cuda;  ///< of the program
  bool dirty = false;
  std::string started, ended, status;           ///< ISO 8601, UTC; status: "running", "finished", "failed: …"
  std::map<std::string, std::string> extra;
};

/// One stored state.
struct Frame {
  std::int64_t step = 0;
  double time = 0;  ///< [s]
  std::vector<Vec3f> positions, velocities;
  std::vector<float> bounds;
};

/// Writes a run. Throws ResourceError (disk full, with the path) and InputError (the folder exists and holds a run).
class RunWriter {
 public:
  RunWriter(std::filesystem::path folder, const Scene& scene, const Provenance& provenance, std::vector<std::string> stage_names);
  void add_steps(const std::vector<StepMetrics>& rows);
  void add_frame(const Frame& frame);
  /// Writes the final run.json and assembles trajectory.vtkhdf.
  void finish(const std::string& status);
  const std::filesystem::path& folder() const { return folder_; }

 private:
  void write_manifest();
  std::filesystem::path folder_;
  Scene scene_;
  Provenance provenance_;
  std::vector<std::string> stage_names_;
};

/// Reads what a run has so far. Throws InputError that names the file.
class RunReader {
 public:
  explicit RunReader(std::filesystem::path folder);
  const Scene& scene() const { return scene_; }
  const Provenance& provenance() const { return provenance_; }
  std::size_t frame_count() const { return frames_.size(); }
  Frame frame(std::size_t i) const;

 private:
  Scene scene_;
  Provenance provenance_;
  std::vector<std::filesystem::path> frames_;
};

/// Assembles trajectory.vtkhdf (temporal PolyData, one block of points and triangles, point data velocity, bound, body) from the frames.
void assemble_trajectory(const std::filesystem::path& folder);

}  // namespace ogc::compare
