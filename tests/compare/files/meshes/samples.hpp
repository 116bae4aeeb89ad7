// A square and a cube in formats that this program reads and does not write, for tests that change them.
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

/// `text` with its first `from` replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("nothing to replace: " + from);
  return text.replace(at, from.size(), to);
}

/// What is said of such a file where no mesh is made of it; empty where one is.
std::string error_of(const std::string& bytes, const std::string& name);

inline const std::string square_off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

/// Corners of the square's two triangles.
inline const std::vector<std::array<int, 3>> square_corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0},
                                                            {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};

std::string square_stl();
/// The square in binary, whose header announces so many facets.
std::string binary_stl(std::uint32_t announced);

/// Four corners as floats, then two triangles in 16 bits: 60 bytes.
std::string gltf_data();
/// The "uri" of a buffer with these bytes.
std::string base64_uri(const std::string& bytes);
/// The square, turned about z by 90°, stretched along x and 3 m up, with `uri` of its buffer; without it, in base64.
std::string square_gltf(const std::string& uri = base64_uri(gltf_data()));
std::string square_glb();

/// A cube of six tetrahedra in Gmsh's binary formats 2.2 and 4.1.
std::string binary_msh(bool is_new, std::endian order = std::endian::little);
/// The same in Medit's and VTK's formats, VTK's in text or in binary, with cells as before or from version 5.
std::string cube_medit();
std::string cube_vtk(bool is_binary, bool is_new);
std::string cube_vtu();

}  // namespace ogc::tests
