// Reads Medit's mesh files (.mesh) in text, as TetGen, Gmsh, fTetWild and Mmg write them.
#pragma once

#include <string>
#include <string_view>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Returns vertices and tetrahedra or, if the file has none, triangles and quadrilaterals. Edges, and faces in a file
/// with tetrahedra, are left out, with a note; other sections are skipped. `name` begins the errors. Throws InputError
/// with file and line: no Medit file, another dimension than three, a count that exceeds the file's size, a file that
/// ends too early, an index out of range, a word that is no number, hexahedra and prisms.
PolygonMesh parse_medit(std::string_view text, const std::string& name);

}  // namespace ogc::compare
