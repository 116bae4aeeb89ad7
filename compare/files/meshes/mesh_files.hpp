// Meshes of files: OBJ, PLY and MSH read and written, others read.
#pragma once

#include <filesystem>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Reads a mesh by extension: .obj (v, f and l), .ply (ascii, binary little- and big-endian), .vtp (vtp_parse.hpp),
/// .msh (msh.hpp), and .stl, .off, .gltf and .glb where the program was built with assimp. Corners' attributes,
/// colours, normals and materials are left out. Throws InputError that names the file, the line or element, and what is
/// wrong: missing file, truncated data, index out of range, NaN.
PolygonMesh read_polygon_mesh(const std::filesystem::path& path);

/// The same, made into a mesh of triangles and loose edges. Coordinates are those of the file, dust included.
LoadedMesh load_mesh(const std::filesystem::path& path, const MeshOptions& options = {});

/// The mesh alone.
Mesh read_mesh(const std::filesystem::path& path);

/// Whether the extension is one of a mesh file that can be read, in capitals or not.
bool is_mesh_file(const std::filesystem::path& path);

enum class PlyEncoding { ascii, binary };  ///< how a PLY file is written

/// Writes by extension: .obj, .ply, or .msh, the only one that holds tetrahedra and holds nothing else. Coordinates are
/// printed so that reading gives the same double (OBJ, MSH, ascii) or stored as double (binary). Throws InputError for
/// another extension, ResourceError where the disk does not take it.
void write_mesh(const std::filesystem::path& path, const Mesh& mesh, PlyEncoding encoding = PlyEncoding::binary);

}  // namespace ogc::compare
