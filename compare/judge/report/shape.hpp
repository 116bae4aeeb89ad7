// Holds the visible part of a case: points, triangles, lines. Meshes for audits and pictures are made from it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "compare/judge/cases/cases.hpp"

namespace ogc::compare {

/// The points, triangles and lines of a case.
struct Shape {
  std::vector<Vec3f> points;                    ///< [m]
  std::vector<std::array<Index, 3>> triangles;  ///< by indices of points
  std::vector<std::array<Index, 2>> lines;      ///< without edges of triangles
  std::vector<Index> dots;                      ///< points that the question concerns

  /// Returns the index of the new point.
  Index add(const Vec3f& point);
  template <class Points>
  void add_all(const Points& more) {
    points.insert(points.end(), more.begin(), more.end());
  }
  /// Adds a mesh. The shape must be empty.
  void add(const Topology& topology, const std::vector<Vec3f>& positions);
};

/// Returns the shape; empty if a case has no coordinates (activation, bound).
Shape shape_of(const TestCase& test);

/// Returns the shape as a legal mesh: OBJ text that `ogc audit` reads.
/// - Triangles and lines without area or length, out of range, or present twice are left out.
/// - A flat triangle is replaced by its longest side.
/// - A point without triangles and lines gets a line away from all other points, so that distances to it stay.
/// - Comments name the points that the question concerns. They also name the index of a vertex in the case if it
///   differs from the OBJ index.
/// The text is empty if nothing is left.
std::string print_shape_obj(const Shape& shape);

/// Returns a static SVG picture, to scale: a parallel projection along the direction of the shape's smallest extent.
/// Vertices are labelled by index if they are few. The text is empty for an empty shape.
std::string print_shape_svg(const Shape& shape, const std::string& title);

}  // namespace ogc::compare
