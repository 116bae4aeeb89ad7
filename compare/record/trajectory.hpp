// Writes trajectory.vtkhdf: VTKHDF 2.0, temporal PolyData. Moving data (points, velocities, bounds) are appended frame
// by frame, and each step has an offset to its rows; fixed data (cells, bodies) are there once, with offset 0 for each
// step. The chunks of a frame are those of its own file, packed once; if its rows end within a chunk, the next frame
// begins with the next chunk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "compare/files/hdf5.hpp"
#include "compare/problem/scene.hpp"
#include "compare/record/frame_file.hpp"

namespace ogc::compare {

/// Makes the file frame by frame, under the name `growing` in the folder of `path` until it is finished.
class TrajectoryWriter {
 public:
  /// Begins the file. Throws ResourceError if the disk fails, as the other functions do.
  TrajectoryWriter(std::filesystem::path path, std::filesystem::path growing, const Scene& scene);
  /// Removes an unfinished file.
  ~TrajectoryWriter();
  TrajectoryWriter(const TrajectoryWriter&) = delete;
  TrajectoryWriter& operator=(const TrajectoryWriter&) = delete;
  /// Appends a frame; frames come in the order of their steps.
  void append(const PackedFrame& frame);
  /// Returns the step of the last frame, -1 before the first one.
  std::int64_t last_step() const { return last_step_; }
  /// Writes the times and gives the file its name; nothing may follow.
  void finish();

 private:
  void reserve(std::size_t more);
  void write_steps();
  std::filesystem::path path_, growing_;
  std::size_t frame_rows_;               ///< rows of a frame, with those that fill up its last chunk
  std::size_t reserved_ = 0, used_ = 0;  ///< bytes of the disk; `used_` is an upper bound
  std::optional<Hdf5File> file_;
  std::vector<double> times_;  ///< [s]
  std::int64_t last_step_ = -1;
};

/// Assembles `folder`/trajectory.vtkhdf from the frames of a run, also while another program writes the run. Throws
/// InputError if there is no frame yet or one is damaged, ResourceError if the disk fails.
void assemble_trajectory(const std::filesystem::path& folder);

}  // namespace ogc::compare
