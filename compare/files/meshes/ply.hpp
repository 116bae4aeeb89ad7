// Reads and writes PLY, ascii, binary little- and big-endian, with any properties that other programs add.
#pragma once

#include <string>
#include <string_view>

#include "compare/files/meshes/mesh_files.hpp"
#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Parses vertices (x, y, z of any scalar type), faces (list vertex_indices or vertex_index, three entries or more) and
/// loose edges (vertex1, vertex2). Other properties and elements are skipped, triangle strips refused. `name` begins
/// the errors. Throws InputError that names the element.
PolygonMesh parse_ply(std::string_view bytes, const std::string& name);

/// Returns the file with positions as double; binary in the byte order of this machine.
std::string print_ply(const Mesh& mesh, PlyEncoding encoding);

}  // namespace ogc::compare
