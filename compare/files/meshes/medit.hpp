// This reads Medit's mesh files (.mesh) in text, as TetGen, Gmsh, fTetWild and Mmg write them.
#pragma once

#include <string>
#include <string_view>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Vertices and tetrahedra, or, where the file has none, triangles and quadrilaterals. Edges, and faces beside
/// tetrahedra, are left out, which a note says; other sections are skipped. `name` stands in the errors. Throws
/// InputError with file and line: no Medit file, another dimension than three, a count that the file has no room for, a
/// file that ends too early, an index out of range, a number that is none, hexahedra and prisms.
PolygonMesh parse_medit(std::string_view text, const std::string& name);

}  // namespace ogc::compare
