// Reads meshes of all formats and writes OBJ, PLY and MSH.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Reads a mesh by extension: .obj (v, f and l), .ply (ascii, binary little- and big-endian), .off, .stl, .gltf, .glb,
/// .vtp, and with tetrahedra .msh (Gmsh), .mesh (Medit), .vtu and .vtk (VTK); each reader's header describes what it
/// reads. Corners' attributes, colours, normals and materials are left out. Numbers of elements are checked against the
/// size of the file before memory is allocated for them. Throws InputError that names the file, the line, element or
/// byte, and the problem: missing file, truncated data, index out of range, NaN.
PolygonMesh read_polygon_mesh(const std::filesystem::path& path);

/// Reads a mesh from the bytes of the file `name`, whose extension decides the format; buffers of glTF may be beside
/// it.
PolygonMesh parse_polygon_mesh(std::string_view bytes, const std::string& name);

/// Reads a file and makes it a mesh of triangles and loose edges. Coordinates are those of the file, dust
/// (compare/problem/dust.hpp) included.
LoadedMesh load_mesh(const std::filesystem::path& path, const MeshOptions& options = {});

/// Reads a file and returns the mesh alone.
Mesh read_mesh(const std::filesystem::path& path);

/// Returns the extensions that can be read: ".obj", …
std::vector<std::string> mesh_extensions();

/// Returns whether mesh files with this extension can be read. Upper and lower case are equal.
bool is_mesh_file(const std::filesystem::path& path);

enum class PlyEncoding { ascii, binary };  ///< format of a PLY file

/// Writes by extension: .obj, .ply, or .msh. Only .msh can store tetrahedra, and it stores nothing else. Coordinates
/// are printed so that reading gives the same double (OBJ, MSH, ascii) or stored as double (binary). Throws InputError
/// for another extension, ResourceError if the disk fails.
void write_mesh(const std::filesystem::path& path, const Mesh& mesh, PlyEncoding encoding = PlyEncoding::binary);

}  // namespace ogc::compare
