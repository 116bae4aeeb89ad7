// Writes trajectory.vtkhdf: VTKHDF 2.0, temporal PolyData. Moving data (points, velocities, bounds) are appended frame
// by frame, and each step has an offset to its rows. Fixed data (cells, bodies) are stored once, with offset 0 for each
// step. A frame's chunks are copied from the frame's file without packing them again. A frame always begins with a new
// chunk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "compare/files/hdf5.hpp"
#include "compare/problem/scene.hpp"
#include "compare/record/frame_file.hpp"

namespace ogc::compare {

/// Writes the file frame by frame. Until it is finished it is called `growing`, in the folder of `path`.
class TrajectoryWriter {
 public:
  /// Begins the file. Throws ResourceError if the disk fails; so do the other functions.
  TrajectoryWriter(std::filesystem::path path, std::filesystem::path growing, const Scene& scene);
  /// Removes an unfinished file.
  ~TrajectoryWriter();
  TrajectoryWriter(const TrajectoryWriter&) = delete;
  TrajectoryWriter& operator=(const TrajectoryWriter&) = delete;
  /// Appends a frame. Frames must come in the order of their steps.
  void append(const PackedFrame& frame);
  /// Returns the step of the last frame, -1 before the first one.
  std::int64_t last_step() const { return last_step_; }
  /// Writes the times and gives the file its name; nothing may be appended afterwards.
  void finish();

 private:
  void reserve(std::size_t more);
  void write_steps();
  std::filesystem::path path_, growing_;
  std::size_t frame_rows_;               ///< rows of a frame, including those that fill its last chunk
  std::size_t reserved_ = 0, used_ = 0;  ///< bytes of the disk; `used_` is an upper bound
  std::optional<Hdf5File> file_;
  std::vector<double> times_;  ///< [s]
  std::int64_t last_step_ = -1;
};

/// Assembles `folder`/trajectory.vtkhdf from the frames of a run; another program may be writing the run. Throws
/// InputError if there is no frame yet or one is damaged, ResourceError if the disk fails.
void assemble_trajectory(const std::filesystem::path& folder);

}  // namespace ogc::compare
