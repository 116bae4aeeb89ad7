// Meshes of files: OBJ, PLY and MSH read and written, others read.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Reads a mesh by extension: .obj (v, f and l), .ply (ascii, binary little- and big-endian), .off, .stl, .gltf, .glb,
/// .vtp, and with tetrahedra .msh (Gmsh), .mesh (Medit), .vtu and .vtk (VTK): each reader's header says what of them.
/// Corners' attributes, colours, normals and materials are left out. Numbers of elements are checked against the size
/// of the file before memory is taken for them. Throws InputError that names the file, the line, element or byte, and
/// what is wrong: missing file, truncated data, index out of range, NaN.
PolygonMesh read_polygon_mesh(const std::filesystem::path& path);

/// The same of bytes that stand in the file `name`, which decides the format; buffers of glTF may stand beside it.
PolygonMesh parse_polygon_mesh(std::string_view bytes, const std::string& name);

/// The same, made into a mesh of triangles and loose edges. Coordinates are those of the file, dust included.
LoadedMesh load_mesh(const std::filesystem::path& path, const MeshOptions& options = {});

/// The mesh alone.
Mesh read_mesh(const std::filesystem::path& path);

/// The extensions that can be read: ".obj", …
std::vector<std::string> mesh_extensions();

/// Whether the extension is one of a mesh file that can be read, in capitals or not.
bool is_mesh_file(const std::filesystem::path& path);

enum class PlyEncoding { ascii, binary };  ///< how a PLY file is written

/// Writes by extension: .obj, .ply, or .msh, the only one that holds tetrahedra and holds nothing else. Coordinates are
/// printed so that reading gives the same double (OBJ, MSH, ascii) or stored as double (binary). Throws InputError for
/// another extension, ResourceError where the disk does not take it.
void write_mesh(const std::filesystem::path& path, const Mesh& mesh, PlyEncoding encoding = PlyEncoding::binary);

}  // namespace ogc::compare
