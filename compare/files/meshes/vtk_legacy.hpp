// Reads VTK's older format (.vtk), in text and in binary. Reads the cells of versions before 5 and of version 5, which
// differ.
#pragma once

#include <string>
#include <string_view>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Returns points and cells of a data set of type POLYDATA or UNSTRUCTURED_GRID: tetrahedra, or faces and lines as for
/// VTK's XML files (vtk_mesh.hpp). Data of points and cells are skipped. `name` begins the errors. Throws InputError
/// with file and line or byte: another data set, a count that exceeds the file's size, a file that ends too early, a
/// vertex out of range, a word that is no number, kinds of cells that are not read.
PolygonMesh parse_vtk_legacy(std::string_view bytes, const std::string& name);

}  // namespace ogc::compare
