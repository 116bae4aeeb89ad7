// Reads OFF in text, with or without colours, normals and texture coordinates.
#pragma once

#include <string>
#include <string_view>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Returns vertices and faces, one from each line. Faces of two corners become loose edges. Faces of one corner are
/// left out, with a note. Numbers after coordinates and corners are skipped. `name` begins the errors. Throws
/// InputError with file and line: no OFF file, a binary file or one of another dimension, counts that exceed the file's
/// size, a file that ends too early or has more lines than elements, an index out of range (the face is named), a word
/// that is no number.
PolygonMesh parse_off(std::string_view text, const std::string& name);

}  // namespace ogc::compare
