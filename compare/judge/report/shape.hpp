// What there is to see of a case: points, triangles, lines; from them a mesh to audit, and a picture.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "compare/judge/cases/cases.hpp"

namespace ogc::compare {

/// Points and what joins them.
struct Shape {
  std::vector<Vec3f> points;                    ///< [m]
  std::vector<std::array<Index, 3>> triangles;  ///< by numbers of points
  std::vector<std::array<Index, 2>> lines;      ///< those of triangles left out
  std::vector<Index> dots;                      ///< points that are asked about

  /// The number of the new point.
  Index add(const Vec3f& point);
  template <class Points>
  void add_all(const Points& more) {
    points.insert(points.end(), more.begin(), more.end());
  }
  /// The first mesh of the shape.
  void add(const Topology& topology, const std::vector<Vec3f>& positions);
};

/// Empty where a case has no coordinates (activation, bound).
Shape shape_of(const TestCase& test);

/// OBJ text that `ogc audit` reads: the shape as a legal mesh. Triangles and lines that no mesh may have (of no length
/// or area, beyond the range of lengths, there twice) are left out, of a flat triangle but its longest side. A point
/// that nothing holds gets a line that leads away from all others, so that distances to it are those of the case.
/// Comments say what is asked about, and which vertex of the case each vertex is where they differ. Empty where nothing
/// is left.
std::string print_shape_obj(const Shape& shape);

/// A static SVG picture: parallel projection along the direction in which the shape is least deep, to scale; vertices
/// carry their numbers where they are few. Empty for an empty shape.
std::string print_shape_svg(const Shape& shape, const std::string& title);

}  // namespace ogc::compare
