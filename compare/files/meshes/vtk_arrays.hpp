// Reads the numbers of a VTK array: text, base64 or raw bytes, in place or appended, stored or compressed by zlib.
#pragma once

#include <string>
#include <vector>

#include "compare/files/meshes/vtk_xml.hpp"

namespace ogc::compare {

/// Returns all numbers of the array, one after the other. Throws InputError that names the array and the byte: an
/// unknown type, format or compressor, a truncated array, or sizes that the file can't hold.
std::vector<double> read_vtk_array(const VtkDocument& document, const VtkArray& array, const std::string& name);

}  // namespace ogc::compare
