// Provides a square and a cube in formats that this program reads but does not write; tests change them.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/compare/files/number_bytes.hpp"

namespace ogc::tests {

/// Returns `text` with the first `from` replaced by `to`. Throws std::logic_error if `from` is missing.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("nothing to replace: " + from);
  return text.replace(at, from.size(), to);
}

/// Returns the error of the reader; "" if it makes a mesh of the file.
std::string error_of(const std::string& bytes, const std::string& name);

inline const std::string square_off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

/// Corners of the square's two triangles.
inline const std::vector<std::array<int, 3>> square_corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0},
                                                            {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};

std::string square_stl();
/// Returns the square in binary STL whose header announces `announced` facets.
std::string binary_stl(std::uint32_t announced);

/// Returns the positions of four corners as floats, then the indices of two triangles as 16-bit numbers: 60 bytes.
std::string gltf_data();
/// Returns the "uri" of a buffer with these bytes.
std::string base64_uri(const std::string& bytes);
/// Returns the square, rotated about z by 90°, then stretched along y by a factor of 2 and moved along z by 3 m. `uri`
/// is the "uri" of the square's buffer, in base64 by default.
std::string square_gltf(const std::string& uri = base64_uri(gltf_data()));
std::string square_glb();

/// Returns a cube of six tetrahedra in Gmsh's binary formats, 4.1 if `is_new`, else 2.2.
std::string binary_msh(bool is_new, std::endian order = std::endian::little);
/// Return the same cube in the formats of Medit and VTK. cube_vtk is binary or text, and lists its cells as version 5
/// of the format does if `is_new`, otherwise as older versions do.
std::string cube_medit();
std::string cube_vtk(bool is_binary, bool is_new);
std::string cube_vtu();

}  // namespace ogc::tests
