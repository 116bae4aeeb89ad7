// Parses the XML of a VTK file: its arrays, and where their numbers are; vtk_arrays.hpp reads the numbers.
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
  XmlAttributes attributes;  ///< attributes of its element
  std::string text;          ///< text between its tags, unless the data are appended
  std::size_t line = 0;      ///< line of its tag
};

/// One <Piece> of the file's data set.
struct VtkPiece {
  XmlAttributes attributes;      ///< attributes of its element
  std::vector<VtkArray> arrays;  ///< in the file's order
};

/// The contents of the XML of a VTK file.
struct VtkDocument {
  XmlAttributes file;            ///< attributes of <VTKFile>
  std::vector<VtkPiece> pieces;  ///< in the file's order
  std::string encoding;          ///< of <AppendedData>: "raw", "base64", or empty without appended data
  std::string_view appended;     ///< the bytes after the underscore, up to the end of the file: a view into the bytes
};

/// Parses the XML of `bytes`; `name` begins the errors. Raw appended data end the XML. Throws InputError with the line
/// if it is no XML or no VTK file, ResourceError if this program was built without expat.
VtkDocument parse_vtk_xml(std::string_view bytes, const std::string& name);

}  // namespace ogc::compare
