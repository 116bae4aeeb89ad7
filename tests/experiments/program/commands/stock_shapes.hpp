// Shapes and files as other programs make them: quads, faces of many corners, the dust of sines, corners with
// attributes, vertices that nothing uses.
#pragma once

#include <string>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::tests {

struct StockShape {
  std::string name;
  std::vector<compare::Vec3> positions;
  std::vector<std::vector<compare::Index>> faces;
  /// Σ (corners − 2): how many triangles the faces make.
  std::size_t triangles() const;
  /// Whether a coordinate is not zero and below 2⁻⁴⁰ of the largest.
  bool has_dust() const;
  bool has_polygons() const;
};

/// Eleven of them, none of which touches itself: open and closed, flat, curved and one-sided.
std::vector<StockShape> stock_shapes();

/// Files of one shape. Those with an unused vertex have it first, far outside.
std::string plain_obj(const StockShape& shape);
/// Normals, texture coordinates, colours, groups, indices from the end, carriage returns; an unused vertex.
std::string dressed_obj(const StockShape& shape);
/// Colours and quality, types by size; an unused vertex.
std::string ascii_ply(const StockShape& shape);
/// Single precision, a user element in between, a list behind each face.
std::string little_endian_ply(const StockShape& shape);
/// Double precision.
std::string big_endian_ply(const StockShape& shape);

/// Facets with a corner each, of faces cut from their first corner.
std::string ascii_stl(const StockShape& shape);
std::string binary_stl(const StockShape& shape);
std::string off(const StockShape& shape);
/// One mesh of triangles with a vertex for each corner, moved by its node.
std::string glb(const StockShape& shape);

}  // namespace ogc::tests
