// This reads STL in text and in binary.
#pragma once

#include <string>
#include <string_view>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Facets of all solids. Each has corners of its own; normals and attributes are skipped. A file is binary where its
/// size is what its count of facets says, or where it does not begin with "solid" or has bytes of no text near its
/// beginning. `name` stands in the errors. Throws InputError that names the facet and the line or the bytes: a file cut
/// within a facet or behind one, bytes that no facet has, a word that does not belong there, a coordinate that is no
/// finite number.
PolygonMesh parse_stl(std::string_view bytes, const std::string& name);

}  // namespace ogc::compare
