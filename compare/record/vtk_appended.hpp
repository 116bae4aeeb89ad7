// Defines what VTK's XML files share: arrays stored after the XML as raw bytes.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compare/problem/local_origin.hpp"
#include "compare/record/frame_file.hpp"

namespace ogc::compare {

/// VTK's name for this machine's byte order.
inline constexpr const char* vtk_byte_order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

/// Collects the arrays that follow the XML. Each array is stored after its length in bytes; the XML refers to an array
/// by its offset.
class AppendedArrays {
 public:
  /// Adds an array and returns its element for the XML. `type`: VTK's type of the numbers; `name`: its name in viewers.
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
  const std::string& bytes() const { return bytes_; }  ///< all arrays so far

 private:
  std::string bytes_;
};

/// Returns the vectors as one array of doubles, three for each vector.
inline std::span<const double> as_doubles(const std::vector<Vec3>& vectors) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double), "rows of three doubles");
  return {vectors.empty() ? nullptr : &vectors.front().x, 3 * vectors.size()};
}

/// Adds the points of a frame and returns their element for the XML. The scene's points are relative to `origin`. If
/// `origin` is 0, points are written in single precision; otherwise in double, in the coordinates of the scene's file.
inline std::string appended_points(AppendedArrays& appended, const Vec3& origin, const std::vector<Vec3f>& positions) {
  if (origin == Vec3{}) return appended.array("Float32", "Points", as_floats(positions), 3);
  const std::vector<Vec3> points = in_file(origin, positions);
  return appended.array("Float64", "Points", as_doubles(points), 3);
}

}  // namespace ogc::compare
