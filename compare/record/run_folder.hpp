// Run folders (design.md §5): run.json, steps.csv, frames/, trajectory.vtkhdf. A run that is killed at any time leaves
// all of its finished frames readable: every file is written under a temporary name, synced and renamed; steps.csv
// grows by whole lines.
//
//   run.json            written last when a run begins, again when it ends: "status" says which
//   scene/NAME.json     the scene, meshes beside it (compare/files/scene_files.hpp)
//   steps.csv           compare/record/steps_csv.hpp
//   frames/frame_000025.h5   the state after step 25: positions, velocities [vertices × 3], bounds [vertices];
//                       attributes format_version, step, time, crc32 (of positions, velocities, bounds, step, time)
//   checkpoint.h5       where the run can go on (compare/record/checkpoint.hpp)
//   trajectory.vtkhdf   all frames, for viewers
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compare/problem/contestant.hpp"
#include "compare/record/checkpoint.hpp"
#include "compare/files/durable_file.hpp"
#include "compare/record/manifest.hpp"

namespace ogc::compare {

/// The newest frames that this program writes and reads. Format 1 has neither its number nor a checksum.
inline constexpr std::int64_t frame_format_version = 2;

/// One stored state.
struct Frame {
  std::int64_t step = 0;                     ///< number of the step that it ends; 0: the start
  double time = 0;                           ///< [s]
  std::vector<Vec3f> positions, velocities;  ///< [m], [m/s]
  std::vector<float> bounds;                 ///< b_v of the last detection [m]
  friend bool operator==(const Frame&, const Frame&) = default;
};

/// "frame_000025", the name of a file that holds the state after a step, without its extension.
std::string frame_name(std::int64_t step);

/// The same memory as rows of three numbers, as files store it.
std::span<const float> as_floats(std::span<const Vec3f> vectors);
/// And back.
std::vector<Vec3f> as_vectors(const std::vector<float>& floats);

/// Throws InputError, before anything is computed for it, where no new run can be written to the folder: it holds one,
/// a file has its name, it can't be made.
void expect_new_run_folder(const std::filesystem::path& folder);

/// Writes a run. Throws ResourceError (disk full or not writable, with the path).
class RunWriter {
 public:
  /// Makes the folder and all that a run has before its first step; status "running". `started` is set to now where it is empty. Stage names give
  /// columns of steps.csv; none for a run without profile. Throws InputError where the folder holds a run already, or what a run would overwrite.
  RunWriter(std::filesystem::path folder, const Scene& scene, const Provenance& provenance, std::vector<std::string> stage_names);
  /// Goes on with the run of the folder after `step`, a checkpoint's: rows of later steps are cut off, as they are written again; status "running", and run.json
  /// says when it went on, with `note`. Scene: the folder's. Throws InputError where another process writes the run, or where it can't be read.
  RunWriter(std::filesystem::path folder, const Scene& scene, std::int64_t step, const std::string& note);
  /// Removes the frames of other steps.
  void keep_frames(const std::function<bool(std::int64_t)>& keep);
  /// Appends rows to steps.csv in one write, and their iteration rows, if there are any, to iterations.csv. Throws std::invalid_argument where a row has times for another number of stages.
  void add_steps(const std::vector<StepMetrics>& rows);
  /// Stores a state; one of the same step is replaced. Throws std::invalid_argument where its arrays have not one entry for each vertex.
  void add_frame(const Frame& frame);
  /// Replaces checkpoint.h5. Rows and frames up to its step must be written before.
  void save(const Checkpoint& checkpoint) const;
  /// Sets an entry of Provenance::extra; the next manifest (at the latest that of finish) carries it.
  void set_extra(const std::string& key, const std::string& value) { manifest_.provenance.extra[key] = value; }
  /// Replaces Provenance::warnings; the next manifest carries them.
  void set_warnings(std::vector<std::string> warnings) { manifest_.provenance.warnings = std::move(warnings); }
  /// Writes the final run.json, then assembles trajectory.vtkhdf where there is a frame.
  void finish(const std::string& status);
  const std::filesystem::path& folder() const { return folder_; }

 private:
  void write_manifest() const;
  std::filesystem::path folder_;
  Scene scene_;
  Manifest manifest_;
  std::string scene_digest_;
  std::optional<LineAppender> steps_, iterations_;
};

/// Reads what a run has so far. Throws InputError that names the file.
class RunReader {
 public:
  explicit RunReader(std::filesystem::path folder);
  const Scene& scene() const { return scene_; }
  const Provenance& provenance() const { return manifest_.provenance; }
  const std::vector<std::string>& stage_names() const { return manifest_.stage_names; }
  std::size_t frame_count() const { return frames_.size(); }
  /// Step of the i-th frame, ascending.
  std::int64_t frame_step(std::size_t i) const { return frames_.at(i).first; }
  /// Throws InputError also where it does not fit the scene.
  Frame frame(std::size_t i) const;

 private:
  Manifest manifest_;
  Scene scene_;
  std::vector<std::pair<std::int64_t, std::filesystem::path>> frames_;  ///< by step
};

/// Reads one file of frames/. Throws InputError that names the file: missing, no frame, damaged (its content is not
/// what its checksum says), of a newer format.
Frame read_frame(const std::filesystem::path& file);

/// Assembles trajectory.vtkhdf (temporal PolyData, one block of points and triangles, point data velocity, bound, body) from the frames. Throws
/// InputError where there is no frame yet, ResourceError where the disk does not take it.
void assemble_trajectory(const std::filesystem::path& folder);

}  // namespace ogc::compare
