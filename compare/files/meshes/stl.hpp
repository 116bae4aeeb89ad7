// Reads STL in text and in binary.
#pragma once

#include <string>
#include <string_view>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Returns the facets of all solids. Each facet has its own vertices; normals and attributes are skipped. A file is
/// binary if its size fits its count of facets, if it does not begin with "solid", or if bytes near its beginning are
/// no text. `name` begins the errors. Throws InputError that names the facet and the line or the bytes: a file cut
/// within or after a facet, bytes that belong to no facet, an unexpected word, a coordinate that is no finite number.
PolygonMesh parse_stl(std::string_view bytes, const std::string& name);

}  // namespace ogc::compare
