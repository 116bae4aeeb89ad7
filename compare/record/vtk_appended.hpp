// What VTK's XML files share: arrays behind the XML as raw bytes.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>

namespace ogc::compare {

/// VTK's name for this machine's byte order.
inline constexpr const char* vtk_byte_order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

/// Collects the arrays behind the XML: each with its length in bytes before it, named in the XML by its offset.
class AppendedArrays {
 public:
  /// Adds an array; its element for the XML. `type`, `name`: VTK's type of the numbers, and what viewers call it.
  template <class T>
  std::string array(const char* type, const char* name, std::span<const T> values, int components = 1) {
    std::string tag = std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                      std::to_string(components) + "\" format=\"appended\" offset=\"" + std::to_string(bytes_.size()) +
                      "\"/>";
    const std::uint64_t size = values.size_bytes();
    bytes_.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes_.append(reinterpret_cast<const char*>(values.data()), size);
    return tag;
  }
  const std::string& bytes() const { return bytes_; }  ///< all arrays so far, as they stand behind the XML

 private:
  std::string bytes_;
};

}  // namespace ogc::compare
