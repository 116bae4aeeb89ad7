// Reads the frames of a simulation by any program, one mesh at a time.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// The frames of a simulation, read one after another.
class MeshSequence {
 public:
  virtual ~MeshSequence() = default;
  virtual std::size_t size() const = 0;  ///< number of frames
  /// Returns the name of the i-th frame: its file, or "frame 3", counted from 0 as arrays are.
  virtual std::string name(std::size_t i) const = 0;
  /// Returns the next frame, frame 0 first; at most size() calls are allowed. Indices are valid and coordinates are
  /// finite. For frames of arrays LoadedMesh::source is empty, so messages number elements from 0. Throws InputError
  /// that names file, frame, and byte or element.
  virtual LoadedMesh next() = 0;
};

using MeshReader = std::function<LoadedMesh(const std::filesystem::path&)>;

/// Reads one mesh from each file in the given order; each mesh has its own triangles.
std::unique_ptr<MeshSequence> mesh_files_sequence(std::vector<std::filesystem::path> files, MeshReader read);

/// Reads the frames of an archive of NumPy arrays (numpy.savez, compressed or not), in C or Fortran order.
///
/// - Positions: `positions` [frames, vertices, 3], or [vertices, 3] for one frame, or one numbered array for each frame
///   (`frame_0`, `frame_1`; `arr_0`, …). Other names: x, vertices, points, verts, v, V, and SMPL's v_template.
/// - Faces, whole numbers: `triangles` [n, 3] and `edges` [n, 2] (edges without a triangle). Other names of triangles:
///   faces, f, F. If no array has such a name, one numbered array of whole numbers [n, 3] has the triangles.
///
/// If the archive has neither faces nor edges, the faces and edges of `topology` are used. If `topology` has positions,
/// it must have as many vertices as a frame.
std::unique_ptr<MeshSequence> npz_sequence(const std::filesystem::path& file, const Mesh* topology);

/// Reads the frames of arrays of positions (numpy.save), one file after another, with the shapes and orders of
/// npz_sequence. There must be at least one file. If `topology` is null, there must be several files, and one of them
/// must contain the triangles.
std::unique_ptr<MeshSequence> npy_sequence(const std::vector<std::filesystem::path>& files, const Mesh* topology);

/// Reads a mesh without positions from arrays: triangles from a .npy, triangles and edges from a .npz. Throws
/// InputError.
Mesh faces_in_arrays(const std::filesystem::path& file);

/// Reads the samples of a point cache (PC2: "POINTCACHE2", version, points, start, rate, samples, then float32,
/// little-endian).
std::unique_ptr<MeshSequence> pc2_sequence(const std::filesystem::path& file, const Mesh* topology);

/// Returns the files of a folder that have one of these extensions (".obj"; upper and lower case are equal), in natural
/// order. Throws InputError if the files have several of these extensions, or if there is no such file.
std::vector<std::filesystem::path> mesh_files_in(const std::filesystem::path& folder,
                                                 const std::vector<std::string>& extensions);

}  // namespace ogc::compare
