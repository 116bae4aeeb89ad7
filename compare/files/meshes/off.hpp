// This reads OFF in text, with or without colours, normals and texture coordinates.
#pragma once

#include <string>
#include <string_view>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Vertices and faces, one a line. Faces of two corners become loose edges, those of one are left out, which a note
/// says; what follows coordinates and corners is skipped. `name` stands in the errors. Throws InputError with file and
/// line: no OFF file, a binary one or one of another dimension, counts that the file has no room for, a file that ends
/// too early or goes on, an index out of range (the face is named), a number that is none.
PolygonMesh parse_off(std::string_view text, const std::string& name);

}  // namespace ogc::compare
