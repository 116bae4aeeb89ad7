// Reads VTK's XML files as ParaView, PyVista and this program write them: PolyData (.vtp), UnstructuredGrid (.vtu).
#pragma once

#include <string>
#include <string_view>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Returns points, polygons, triangle strips (as triangles), lines (as loose edges) and tetrahedra of all pieces. If
/// there are tetrahedra, other cells are left out, with a note; other data and single points are skipped. `name` begins
/// the errors. Throws InputError that names the array or cell, ResourceError if this program was built without expat.
PolygonMesh parse_vtk_xml_mesh(std::string_view bytes, const std::string& name);

}  // namespace ogc::compare
