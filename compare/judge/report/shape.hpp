// Holds what can be seen of a case: points, triangles, lines. A mesh to audit and a picture are made from it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "compare/judge/cases/cases.hpp"

namespace ogc::compare {

/// Points, and the triangles and lines between them.
struct Shape {
  std::vector<Vec3f> points;                    ///< [m]
  std::vector<std::array<Index, 3>> triangles;  ///< by numbers of points
  std::vector<std::array<Index, 2>> lines;      ///< without the sides of triangles
  std::vector<Index> dots;                      ///< points that the question is about

  /// Returns the number of the new point.
  Index add(const Vec3f& point);
  template <class Points>
  void add_all(const Points& more) {
    points.insert(points.end(), more.begin(), more.end());
  }
  /// Adds a mesh, which must be the first of the shape.
  void add(const Topology& topology, const std::vector<Vec3f>& positions);
};

/// Returns the shape; empty where a case has no coordinates (activation, bound).
Shape shape_of(const TestCase& test);

/// Returns the shape as a legal mesh: OBJ text that `ogc audit` reads. Triangles and lines that no mesh may have
/// (without length or area, beyond the range of lengths, present twice) are left out; of a flat triangle its longest
/// side stays. A point that nothing holds gets a line that leads away from all others, so that distances to it are
/// those of the case. Comments name the points that the question is about, and the vertex of the case that each vertex
/// is, where the numbers differ. Empty where nothing is left.
std::string print_shape_obj(const Shape& shape);

/// Returns a static SVG picture: a parallel projection along the direction in which the shape is least deep, to scale;
/// vertices carry their numbers where they are few. Empty for an empty shape.
std::string print_shape_svg(const Shape& shape, const std::string& title);

}  // namespace ogc::compare
