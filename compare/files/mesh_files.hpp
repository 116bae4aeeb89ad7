// OBJ and PLY meshes, read and written, and VTP, read.
#pragma once

#include <filesystem>

#include "compare/problem/mesh.hpp"

namespace ogc::compare {

/// Reads .obj (v, f with any number of corners' attributes ignored, polygons of more than three corners refused, l for loose edges) or .ply (ascii,
/// binary little- and big-endian), or .vtp (vtp_parse.hpp). Throws InputError that names the file, the line or element, and what is wrong: missing file, truncated data, index out of range, NaN.
Mesh read_mesh(const std::filesystem::path& path);

enum class PlyEncoding { ascii, binary };

/// Writes by extension: .obj or .ply. Coordinates are printed so that reading gives the same double (OBJ, ascii) or stored as double (binary).
/// Throws ResourceError where the disk does not take it.
void write_mesh(const std::filesystem::path& path, const Mesh& mesh, PlyEncoding encoding = PlyEncoding::binary);

}  // namespace ogc::compare
