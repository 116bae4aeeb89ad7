// Reads an array of positions as frames, in C or Fortran order, from any kind of file.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compare/files/frames/mesh_sequence.hpp"
#include "compare/files/frames/npy.hpp"

namespace ogc::compare {

/// Holds the extents of an array [frames, vertices, 3], and how its numbers are stored.
struct FrameLayout {
  std::uint64_t frames = 0, vertices = 0;   ///< at least 1, but `frames` may be 0 in an array without frames
  ScalarType type = ScalarType::float32;    ///< type of a coordinate
  std::endian order = std::endian::little;  ///< byte order of a coordinate
  bool first_fastest = false;               ///< Fortran order: successive numbers belong to successive frames
  std::uint64_t frame_bytes() const { return vertices * 3 * size_of(type); }  ///< size of one frame
};

/// Opens an array and returns a source of its bytes from the first number on; each call opens the array anew.
using ArrayOpener = std::function<ByteSource()>;

/// Returns the frames of an array. In C order each frame is read on demand, so that memory holds one frame. In Fortran
/// order each frame is spread over the whole array: a pass over the array gathers as many frames as fit into `room`
/// bytes, at least one. `topology` has the faces and edges of all frames. `where` begins messages. Throws InputError if
/// a face refers to a missing vertex.
std::unique_ptr<MeshSequence> frame_array(std::string where, const FrameLayout& layout, Mesh topology, ArrayOpener open,
                                          std::uint64_t room);

/// One of several arrays that make up a sequence.
struct FramePart {
  std::string name;                                     ///< name of its file or archive member
  std::uint64_t frames = 0;                             ///< number of frames
  std::function<std::unique_ptr<MeshSequence>()> open;  ///< opens its frames
};

/// Returns the frames of all arrays, one array after another.
std::unique_ptr<MeshSequence> chained(std::vector<FramePart> parts);

}  // namespace ogc::compare
