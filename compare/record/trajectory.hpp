// trajectory.vtkhdf: VTKHDF 2.0, temporal PolyData. What moves (points, velocities, bounds) stands one frame behind the
// other and each step says where its rows begin; what does not (cells, bodies) stands once, and each step's offset into
// it is 0. The chunks of a frame are those of its own file, packed once; where its rows end within a chunk, the next
// frame begins with the next chunk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "compare/files/hdf5.hpp"
#include "compare/problem/scene.hpp"
#include "compare/record/frame_file.hpp"

namespace ogc::compare {

/// Makes the file frame by frame, under another name until it is finished: `growing`, in the same folder as `path`.
class TrajectoryWriter {
 public:
  /// Throws ResourceError where the disk does not take it, as the other functions do.
  TrajectoryWriter(std::filesystem::path path, std::filesystem::path growing, const Scene& scene);
  /// What is not finished is removed.
  ~TrajectoryWriter();
  TrajectoryWriter(const TrajectoryWriter&) = delete;
  TrajectoryWriter& operator=(const TrajectoryWriter&) = delete;
  /// Frames come in the order of their steps.
  void append(const PackedFrame& frame);
  /// Of the last frame, -1 before the first one.
  std::int64_t last_step() const { return last_step_; }
  /// Writes the times and gives the file its name; nothing may follow.
  void finish();

 private:
  void reserve(std::size_t more);
  void write_steps();
  std::filesystem::path path_, growing_;
  std::size_t frame_rows_;               ///< of a frame with those that fill up its last chunk
  std::size_t reserved_ = 0, used_ = 0;  ///< bytes of the disk; `used_` at most
  std::optional<Hdf5File> file_;
  std::vector<double> times_;  ///< [s]
  std::int64_t last_step_ = -1;
};

/// Assembles `folder`/trajectory.vtkhdf from the frames of a run, also while another program writes the run. Throws
/// InputError where there is no frame yet or one is damaged, ResourceError where the disk does not take it.
void assemble_trajectory(const std::filesystem::path& folder);

}  // namespace ogc::compare
