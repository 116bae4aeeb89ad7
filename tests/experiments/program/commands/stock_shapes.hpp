// Generates shapes and files as other programs write them: with quads, polygons, coordinates that are tiny instead of
// zero, corners with attributes, and unused vertices.
#pragma once

#include <string>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::tests {

struct StockShape {
  std::string name;
  std::vector<compare::Vec3> positions;
  std::vector<std::vector<compare::Index>> faces;
  /// Returns Σ (corners − 2) over the faces, the number of triangles into which they are cut.
  std::size_t triangles() const;
  /// Returns whether a coordinate is tiny: not 0, but below 2⁻⁴⁰ of the largest one.
  bool has_dust() const;
  bool has_polygons() const;
};

/// Returns eleven shapes without self-intersection: open and closed, flat, curved and one-sided.
std::vector<StockShape> stock_shapes();

/// Each function below returns the text of a file with one shape. If a file has an unused vertex, it is the first
/// vertex, far from the shape.
std::string plain_obj(const StockShape& shape);
/// Writes normals, texture coordinates, colours, groups, negative indices, carriage returns, and an unused vertex.
std::string dressed_obj(const StockShape& shape);
/// Writes colours, quality, types with sizes in their names, and an unused vertex.
std::string ascii_ply(const StockShape& shape);
/// Writes coordinates in single precision, texture coordinates, and an element besides vertices and faces.
std::string little_endian_ply(const StockShape& shape);
/// Writes coordinates in double precision, and corners as 32-bit counts and indices.
std::string big_endian_ply(const StockShape& shape);

/// Writes three separate corners for each triangle. Polygons are cut into triangles from their first corner.
std::string ascii_stl(const StockShape& shape);
std::string binary_stl(const StockShape& shape);
std::string off(const StockShape& shape);
/// Writes one mesh of triangles with separate corners; its node has a translation.
std::string glb(const StockShape& shape);

}  // namespace ogc::tests
