// Reads and writes the part of Wavefront OBJ that is a mesh of faces with loose edges.
#pragma once

#include <string>
#include <string_view>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Parses v (first three numbers), f (three corners or more: a, a/b, a//c or a/b/c; attributes ignored) and l
/// (polylines); indices from 1, or negative from the last vertex so far. Normals, texture coordinates, groups,
/// materials and points are skipped, other statements refused. `name` begins the errors. Throws InputError that names
/// the line.
PolygonMesh parse_obj(std::string_view text, const std::string& name);

/// Returns v, f and l lines; coordinates in the shortest text that reads back as the same double.
std::string print_obj(const Mesh& mesh);

}  // namespace ogc::compare
