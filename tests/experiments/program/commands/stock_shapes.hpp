// Makes shapes and files in the forms of other programs: quads, faces of many corners, the dust of sines, corners with
// attributes, unused vertices.
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
  /// Returns whether a coordinate is not zero but below 2⁻⁴⁰ of the largest.
  bool has_dust() const;
  bool has_polygons() const;
};

/// Returns eleven shapes that do not touch themselves: open and closed, flat, curved and one-sided.
std::vector<StockShape> stock_shapes();

/// The functions below return a file of one shape. An unused vertex, if there is one, comes first, far outside.
std::string plain_obj(const StockShape& shape);
/// Has normals, texture coordinates, colours, groups, indices from the end, carriage returns, and an unused vertex.
std::string dressed_obj(const StockShape& shape);
/// Has colours and quality, types by size, and an unused vertex.
std::string ascii_ply(const StockShape& shape);
/// Has single precision, a user element in between, and a list after each face.
std::string little_endian_ply(const StockShape& shape);
/// Has double precision.
std::string big_endian_ply(const StockShape& shape);

/// Has facets with a corner each, of faces cut from their first corner.
std::string ascii_stl(const StockShape& shape);
std::string binary_stl(const StockShape& shape);
std::string off(const StockShape& shape);
/// Has one mesh of triangles with a vertex for each corner, moved by its node.
std::string glb(const StockShape& shape);

}  // namespace ogc::tests
