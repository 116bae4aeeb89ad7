// Writes and reads run folders: run.json, steps.csv, frames/, trajectory.vtkhdf.
//
//   run.json            written last when a run begins, and again when it ends, with its "status"
//   scene/NAME.json     the scene, with its meshes beside it (compare/files/scenes/scene_files.hpp)
//   steps.csv           compare/record/steps_csv.hpp
//   frames/frame_000025.h5   the state after step 25 (compare/record/frame_file.hpp)
//   checkpoint.h5       the state from which the run can continue (compare/record/checkpoint.hpp)
//   trajectory.vtkhdf   all frames, for viewers (compare/record/trajectory.hpp); during the run it is called
//                       trajectory.vtkhdf.growing
//
// Separate threads pack and write frames and checkpoints (compare/record/writing_queue.hpp). Guarantees:
//
//   - A file under its final name is complete, however the program or the machine ends: it is written under another
//     name, synced, then renamed. steps.csv grows by lines; readers ignore an incomplete last line.
//   - At most a second after a write, and at the end, one call syncs everything that was written; then frames get their
//     final names. So a power cut loses the last second, and more only if the disk is too slow.
//   - kill -9 loses no frame that `written()` counts, and no row of a call of add_steps that has returned.
//   - A checkpoint is written after all frames and rows up to its step are synced, so a run continued from it has them.
//   - At most 64 frames and checkpoints, or 256 MiB of them, wait or are being written; beyond that add_frame and save
//     wait.
//   - If another thread fails (a full disk), the next call throws that error; everything written until then is kept.
//   - A killed run leaves a growing trajectory that is not used; a continued run makes it again from the frames.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/files/durable_file.hpp"
#include "compare/record/checkpoint.hpp"
#include "compare/record/frame_file.hpp"
#include "compare/record/manifest.hpp"
#include "compare/record/steps_csv.hpp"
#include "compare/record/trajectory.hpp"
#include "compare/record/writing_queue.hpp"

namespace ogc::compare {

/// Throws InputError if no run can begin in the folder: it contains a run, it is a file, or it can't be created. Call
/// it before anything is computed.
void expect_new_run_folder(const std::filesystem::path& folder);

/// Writes the scene into the folder `scene` of a run's folder, under a temporary name that is replaced when all is
/// written. Returns the scene's file relative to `folder`.
std::string store_scene(const std::filesystem::path& folder, const Scene& scene);
/// Returns the groups of columns that the steps of a run have.
StepGroups groups_of(const Scene& scene, const Manifest& manifest);

/// Writes a run. Throws ResourceError with the path if the disk is full or not writable.
class RunWriter {
 public:
  /// Creates the folder and all files that a run has before its first step, with status "running". If `started` is
  /// empty, it is set to now. steps.csv gets a column for each stage name (none for a run without profile). It also
  /// gets the columns of a ledger if Provenance::extra has "ledger" with the value "yes", and the column of meetings if
  /// Provenance::extra has "meetings". Throws InputError if the folder already contains a run, or files that a run
  /// would overwrite.
  RunWriter(std::filesystem::path folder, const Scene& scene, const Provenance& provenance,
            std::vector<std::string> stage_names);
  /// Continues the run of the folder after `step`, the step of a checkpoint. Removes rows of later steps, since these
  /// steps run again, and sets the status to "running". run.json gets the time of the restart, with `note`. `scene` is
  /// the folder's scene. Throws InputError if another process writes the run, or if it can't be read.
  RunWriter(std::filesystem::path folder, const Scene& scene, std::int64_t step, const std::string& note);
  /// Removes the frames of steps for which `keep` is false.
  void keep_frames(const std::function<bool(std::int64_t)>& keep);
  /// Appends rows to steps.csv in one write, and their iteration rows, if there are any, to iterations.csv. Throws
  /// std::invalid_argument if a row has times for another number of stages.
  void add_steps(const std::vector<StepMetrics>& rows);
  /// Stores a state; replaces a stored state of the same step. Throws std::invalid_argument if an array does not have
  /// one entry for each vertex.
  void add_frame(Frame frame);
  /// Replaces checkpoint.h5. Rows and frames up to its step must be added first.
  void save(Checkpoint checkpoint);
  /// Waits until everything that was added is on the disk.
  void flush() { queue_.drain(); }
  /// Sets an entry of Provenance::extra, which the next run.json contains; the final one is written at the latest.
  void set_extra(const std::string& key, const std::string& value) { manifest_.provenance.extra[key] = value; }
  /// Replaces Provenance::warnings; the next run.json contains them.
  void set_warnings(std::vector<std::string> warnings) { manifest_.provenance.warnings = std::move(warnings); }
  /// Flushes and, if there is a frame, completes trajectory.vtkhdf. Nothing may be added afterwards.
  void close();
  /// Closes, then writes the final run.json.
  void finish(const std::string& status);
  /// Completes as much as possible after an error, then writes the final run.json.
  void give_up(const std::string& status);
  const std::filesystem::path& folder() const { return folder_; }

  /// Counts frames that are synced on the disk under their names.
  struct Written {
    std::int64_t frames = 0;      ///< number of frames of this writer
    std::int64_t last_step = -1;  ///< step of the last frame of this writer, or of the continued run
  };
  Written written() const { return {written_frames_, written_step_}; }  ///< what is synced on the disk
  /// Returns the time that calls waited for the disk [s].
  double waited_seconds() const { return queue_.waited_seconds() + closing_seconds_; }

 private:
  void write_manifest() const;
  void write_frame(const PackedFrame& frame);
  void grow_trajectory(const PackedFrame& frame);
  void complete_trajectory();
  void commit();
  std::filesystem::path folder_;
  Scene scene_;
  Manifest manifest_;
  std::string scene_digest_;
  std::optional<LineAppender> steps_, iterations_;
  // The writing thread uses these members; the caller's thread may use them only after a flush.
  std::vector<std::filesystem::path> uncommitted_;  ///< frames that do not have their final names yet
  std::int64_t uncommitted_step_ = -1;              ///< step of the last uncommitted frame
  std::optional<TrajectoryWriter> trajectory_;
  bool disordered_ = false;  ///< whether a frame was added out of order, so that the trajectory can't be appended to
  std::atomic<std::int64_t> written_frames_ = 0, written_step_ = -1;
  double closing_seconds_ = 0;
  bool closed_ = false;
  WritingQueue queue_;  ///< last, so that its threads end before the members that they use are destroyed
};

/// Reads the finished files of a run; another process may still be writing the run. Throws InputError that names the
/// file.
class RunReader {
 public:
  explicit RunReader(std::filesystem::path folder);
  const Scene& scene() const { return scene_; }                                          ///< the scene of the run
  const Provenance& provenance() const { return manifest_.provenance; }                  ///< provenance in run.json
  const std::vector<std::string>& stage_names() const { return manifest_.stage_names; }  ///< columns of `--profile`
  std::size_t frame_count() const { return frames_.size(); }                             ///< number of finished frames
  /// Returns the step of the i-th frame, ascending.
  std::int64_t frame_step(std::size_t i) const { return frames_.at(i).first; }
  /// Returns a frame. Throws InputError as read_frame does, and if the frame does not fit the scene.
  Frame frame(std::size_t i) const;
  /// Returns a frame as it is stored, with the checks of `frame`.
  PackedFrame packed_frame(std::size_t i) const;

 private:
  void check_size(std::size_t i, std::size_t vertices) const;
  Manifest manifest_;
  Scene scene_;
  std::vector<std::pair<std::int64_t, std::filesystem::path>> frames_;  ///< by step
};

}  // namespace ogc::compare
