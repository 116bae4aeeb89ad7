// frames/frame_000025.h5: the state after step 25 as positions, velocities [vertices × 3] and bounds [vertices], with
// the attributes format_version, step, time and crc32, of the bytes of positions, velocities, bounds, step and time; of
// rods also orientations [segments × 4], whose bytes come last.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "compare/files/packing.hpp"
#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// The newest frames that this program writes and reads. Format 1 has neither its number nor a checksum; orientations
/// come with format 3, where there are rods.
inline constexpr std::int64_t frame_format_version = 3;

/// One stored state.
struct Frame {
  std::int64_t step = 0;                     ///< number of the step that it ends; 0: the start
  double time = 0;                           ///< [s]
  std::vector<Vec3f> positions, velocities;  ///< [m], [m/s]
  std::vector<float> bounds;                 ///< b_v of the last detection [m]
  std::vector<Quaternion> orientations{};    ///< of the segments of rods, as in Snapshot
  friend bool operator==(const Frame&, const Frame&) = default;
};

/// The same as it is stored; making it takes most of the time of writing, and can be done on any thread.
struct PackedFrame {
  std::int64_t step = 0;                      ///< as in Frame
  double time = 0;                            ///< [s]
  std::int64_t checksum = 0;                  ///< CRC-32, see above
  PackedArray positions, velocities, bounds;  ///< as in Frame
  PackedArray orientations{};                 ///< likewise; no rows: there are none
};

/// "frame_000025", the name of a file that holds the state after a step, without its extension.
std::string frame_name(std::int64_t step);

/// The same memory as rows of three numbers, as files store it.
std::span<const float> as_floats(std::span<const Vec3f> vectors);
/// The vectors of which as_floats makes these floats.
std::vector<Vec3f> as_vectors(const std::vector<float>& floats);

PackedFrame pack(const Frame& frame);  ///< without loss

/// The bytes of the file.
std::string frame_bytes(const PackedFrame& frame);

/// Reads one file of frames/. Throws InputError that names the file: missing, no frame, damaged (its content is not
/// what its checksum says), of a newer format, with an orientation that is no unit quaternion.
Frame read_frame(const std::filesystem::path& file);

/// The same, checked likewise, as it is stored.
PackedFrame read_packed_frame(const std::filesystem::path& file);

}  // namespace ogc::compare
