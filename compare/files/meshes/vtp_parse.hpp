// VTK's XML PolyData, as ParaView, PyVista and this program write it.
#pragma once

#include <string>
#include <string_view>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Points, polygons, triangle strips (as triangles) and lines (as loose edges) of all pieces; other
/// data and single points are skipped. `name` stands in the errors. Throws InputError that names the array or cell,
/// ResourceError where this program was built without expat.
PolygonMesh parse_vtp(std::string_view bytes, const std::string& name);

}  // namespace ogc::compare
