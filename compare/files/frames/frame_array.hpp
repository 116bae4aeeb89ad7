// One array of positions as frames, in either order of its numbers, of whatever file.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compare/files/frames/mesh_sequence.hpp"
#include "compare/files/frames/npy.hpp"

namespace ogc::compare {

/// The extents of an array [frames, vertices, 3], and how its numbers are stored.
struct FrameLayout {
  std::uint64_t frames = 0, vertices = 0;   ///< both at least 1, but for an array without a frame
  ScalarType type = ScalarType::float32;    ///< of a coordinate
  std::endian order = std::endian::little;  ///< of its bytes
  bool first_fastest = false;               ///< Fortran order: the frame changes from number to number
  std::uint64_t frame_bytes() const { return vertices * 3 * size_of(type); }  ///< of one frame
};

/// Goes to the first number of an array; each call begins again.
using ArrayOpener = std::function<ByteSource()>;

/// Frames of an array. In C order each is read where it is asked for, so that memory holds one. In Fortran order every
/// frame is spread over the whole array: each pass over it gathers as many as fit into `room` bytes, or one.
/// `topology`: faces and edges of all frames. `where` begins messages. Throws InputError where a face names no vertex.
std::unique_ptr<MeshSequence> frame_array(std::string where, const FrameLayout& layout, Mesh topology, ArrayOpener open,
                                          std::uint64_t room);

/// A part of a sequence: an array among several.
struct FramePart {
  std::string name;                                     ///< of its file, or of a member of an archive
  std::uint64_t frames = 0;                             ///< that it has
  std::function<std::unique_ptr<MeshSequence>()> open;  ///< its frames
};

/// The frames of all parts, one after another.
std::unique_ptr<MeshSequence> chained(std::vector<FramePart> parts);

}  // namespace ogc::compare
