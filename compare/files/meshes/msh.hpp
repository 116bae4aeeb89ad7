// Gmsh's mesh files, formats 2.2 and 4.1 in text: nodes and tetrahedra are read, whatever else stands there is checked
// for its length and left out.
#pragma once

#include <string>
#include <string_view>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Nodes in the order of their tags, tetrahedra of four nodes in the order of the file; elements of lower dimension are
/// left out with a word. Throws InputError with file and line: another format or a binary file, a section that ends too
/// early or is missing, a number that is none, a tag that stands twice or is not there, tetrahedra of higher order,
/// hexahedra, prisms and pyramids, no tetrahedron at all.
PolygonMesh parse_msh(std::string_view text, const std::string& name);

/// Format 4.1: one volume, tags from 1; numbers are printed so that reading gives the same double. Triangles and loose
/// edges are left out.
std::string print_msh(const Mesh& mesh);

}  // namespace ogc::compare
