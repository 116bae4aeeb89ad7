// Reads and writes Gmsh's mesh files, formats 2.2 and 4.1 in text. Reads nodes and tetrahedra, and checks only the
// length of other contents.
#pragma once

#include <string>
#include <string_view>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Returns nodes in the order of their tags and tetrahedra of four nodes in the order of the file; elements of lower
/// dimension are left out with a note. Throws InputError with file and line: another format or a binary file, a section
/// that ends too early or is missing, a word that is no number, a repeated or unknown tag, tetrahedra of higher order,
/// hexahedra, prisms and pyramids, no tetrahedron at all.
PolygonMesh parse_msh(std::string_view text, const std::string& name);

/// Returns the text in format 4.1: one volume, tags from 1, numbers printed so that reading gives the same double.
/// Triangles and loose edges are left out.
std::string print_msh(const Mesh& mesh);

}  // namespace ogc::compare
