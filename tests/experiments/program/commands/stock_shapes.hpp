// Generates shapes and files as other programs write them: quads, polygons, dust from sines, corners with attributes,
// unused vertices.
#pragma once

#include <string>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::tests {

struct StockShape {
  std::string name;
  std::vector<compare::Vec3> positions;
  std::vector<std::vector<compare::Index>> faces;
  /// Returns Σ (corners − 2), the number of triangles that the faces make.
  std::size_t triangles() const;
  /// Returns whether a non-zero coordinate is below 2⁻⁴⁰ of the largest one.
  bool has_dust() const;
  bool has_polygons() const;
};

/// Returns eleven shapes without self-contact: open and closed, flat, curved and one-sided.
std::vector<StockShape> stock_shapes();

/// The functions below return a file of one shape. If the format has an unused vertex, it comes first and lies far
/// outside.
std::string plain_obj(const StockShape& shape);
/// Writes normals, texture coordinates, colours, groups, negative indices, carriage returns, and an unused vertex.
std::string dressed_obj(const StockShape& shape);
/// Writes colours, quality, types with sizes in their names, and an unused vertex.
std::string ascii_ply(const StockShape& shape);
/// Writes single precision, a user-defined element in the middle, and a list after each face.
std::string little_endian_ply(const StockShape& shape);
/// Writes double precision.
std::string big_endian_ply(const StockShape& shape);

/// Writes separate corners for each facet; polygons are cut from their first corner.
std::string ascii_stl(const StockShape& shape);
std::string binary_stl(const StockShape& shape);
std::string off(const StockShape& shape);
/// Writes one mesh of triangles with separate corners, which its node translates.
std::string glb(const StockShape& shape);

}  // namespace ogc::tests
