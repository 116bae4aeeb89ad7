// Stores the state after step 25 in frames/frame_000025.h5: positions, velocities [vertices × 3] and bounds [vertices].
// Attributes are format_version, step, time and crc32, a checksum of the bytes of positions, velocities, bounds, step
// and time. What follows is there if the run has it, and its bytes come next in the checksum: orientations of rods
// [segments × 4], residual and cut [vertices].
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "compare/files/packing.hpp"
#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Newest version of frames that this program writes and reads. Format 1 has neither format_version nor a checksum;
/// format 3 adds orientations if there are rods, format 4 residual and cut if they are measured.
inline constexpr std::int64_t frame_format_version = 4;

/// One stored state.
struct Frame {
  std::int64_t step = 0;                     ///< number of the step that ends in this state; 0: the start
  double time = 0;                           ///< [s]
  std::vector<Vec3f> positions, velocities;  ///< [m], [m/s]
  std::vector<float> bounds;                 ///< b_v of the last detection [m]
  std::vector<Quaternion> orientations{};    ///< orientations of the segments of rods, in the order of Snapshot
  /// the vertex's part of the residual of the step (Eq. 29), not-a-number unless free; empty if not measured [1]
  std::vector<float> residual{};
  std::vector<float> cut{};  ///< 1: the step's last iteration cut the vertex; 0: not; empty if not measured
  friend bool operator==(const Frame&, const Frame&) = default;
};

/// A frame as it is stored. Packing takes most of the time of writing, and any thread can do it.
struct PackedFrame {
  std::int64_t step = 0;                      ///< defined as in Frame
  double time = 0;                            ///< [s]
  std::int64_t checksum = 0;                  ///< CRC-32, defined in the head of this file
  PackedArray positions, velocities, bounds;  ///< arrays of Frame
  PackedArray orientations{};                 ///< without rows if there are no rods
  PackedArray residual{}, cut{};              ///< without rows if not measured
};

/// Returns "frame_000025", the file name of the state after a step, without extension.
std::string frame_name(std::int64_t step);

/// Returns the same memory as floats, three for each vector, as files store them.
std::span<const float> as_floats(std::span<const Vec3f> vectors);
/// Returns the vectors that consist of these floats; the inverse of as_floats.
std::vector<Vec3f> as_vectors(const std::vector<float>& floats);

PackedFrame pack(const Frame& frame);  ///< packs a frame without loss

/// Returns the bytes of a frame's file.
std::string frame_bytes(const PackedFrame& frame);

/// Reads one file of frames/. Throws InputError that names the file if it is missing, no frame, damaged (its content
/// differs from its checksum), or of a newer format, or if an array has another number of rows than there are vertices,
/// or if an orientation is no unit quaternion.
Frame read_frame(const std::filesystem::path& file);

/// Reads and checks a frame as read_frame does, but leaves it packed.
PackedFrame read_packed_frame(const std::filesystem::path& file);

}  // namespace ogc::compare
