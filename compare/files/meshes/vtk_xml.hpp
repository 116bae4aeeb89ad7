// The XML of a VTK file: which arrays there are and where their numbers stand. The numbers are vtk_arrays.hpp's.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ogc::compare {

using XmlAttributes = std::map<std::string, std::string>;

/// One <DataArray> of a <Piece>.
struct VtkArray {
  std::string section;       ///< the element around it: "Points", "Polys", …
  XmlAttributes attributes;  ///< of its element
  std::string text;          ///< what stands between its tags, where it is not appended
  std::size_t line = 0;      ///< of its tag
};

/// One <Piece> of the file's data set.
struct VtkPiece {
  XmlAttributes attributes;      ///< of its element
  std::vector<VtkArray> arrays;  ///< in the file's order
};

/// What the XML of a VTK file says.
struct VtkDocument {
  XmlAttributes file;            ///< of <VTKFile>
  std::vector<VtkPiece> pieces;  ///< in the file's order
  std::string encoding;          ///< of <AppendedData>: "raw", "base64", or empty where there is none
  std::string_view appended;     ///< what follows the underscore, up to the end of the file: a view into the bytes
};

/// Parses the XML of `bytes`; `name` stands in the errors. Raw appended data ends the XML. Throws InputError with the
/// line where it is no XML or no VTK file, ResourceError where this program was built without expat.
VtkDocument parse_vtk_xml(std::string_view bytes, const std::string& name);

}  // namespace ogc::compare
