// Stores in frames/frame_000025.h5 the state after step 25: positions, velocities [vertices × 3] and bounds [vertices],
// with the attributes format_version, step, time and crc32, a checksum of the bytes of positions, velocities, bounds,
// step and time. With rods also orientations [segments × 4], whose bytes come last in the checksum.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "compare/files/packing.hpp"
#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Newest version of frames that this program writes and reads. Format 1 has neither its number nor a checksum;
/// orientations come with format 3, if there are rods.
inline constexpr std::int64_t frame_format_version = 3;

/// One stored state.
struct Frame {
  std::int64_t step = 0;                     ///< number of the step that ends in this state; 0: the start
  double time = 0;                           ///< [s]
  std::vector<Vec3f> positions, velocities;  ///< [m], [m/s]
  std::vector<float> bounds;                 ///< b_v of the last detection [m]
  std::vector<Quaternion> orientations{};    ///< of the segments of rods, in the order of Snapshot
  friend bool operator==(const Frame&, const Frame&) = default;
};

/// A frame as it is stored; packing takes most of the time of writing, and any thread can do it.
struct PackedFrame {
  std::int64_t step = 0;                      ///< defined as in Frame
  double time = 0;                            ///< [s]
  std::int64_t checksum = 0;                  ///< CRC-32, defined in the head of this file
  PackedArray positions, velocities, bounds;  ///< arrays of Frame
  PackedArray orientations{};                 ///< without rows if there are none
};

/// Returns "frame_000025", the name of the file of the state after a step, without its extension.
std::string frame_name(std::int64_t step);

/// Returns the same memory as rows of three numbers, as files store it.
std::span<const float> as_floats(std::span<const Vec3f> vectors);
/// Returns the vectors whose floats as_floats gives.
std::vector<Vec3f> as_vectors(const std::vector<float>& floats);

PackedFrame pack(const Frame& frame);  ///< without loss

/// Returns the bytes of the file.
std::string frame_bytes(const PackedFrame& frame);

/// Reads one file of frames/. Throws InputError that names the file if it is missing, no frame, damaged (its content
/// differs from its checksum), of a newer format, or has an orientation that is no unit quaternion.
Frame read_frame(const std::filesystem::path& file);

/// Reads and checks it in the same way, but leaves it packed.
PackedFrame read_packed_frame(const std::filesystem::path& file);

}  // namespace ogc::compare
