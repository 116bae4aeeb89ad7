// Computes the angle of a hinge, over any number type (compare/stages/bending.hpp).
#pragma once

#include <algorithm>

#include "compare/stages/bending.hpp"
#include "reference/energies/derivative.hpp"

namespace ogc::reference {

/// The vertices of a hinge: the ends x0 and x1 of the edge, then the opposite vertices o0 and o1.
template <class T>
using Hinge = std::array<Triple<T>, 4>;

/// Returns whether all coordinates are 0. Over SIMD lanes, returns one truth value for each lane.
template <class T>
auto is_zero(const Triple<T>& a) {
  return plain(a[0]) == 0.0 && plain(a[1]) == 0.0 && plain(a[2]) == 0.0;
}

template <class T>
double plain_length(const Triple<T>& a) {
  return std::hypot(plain(a[0]), plain(a[1]), plain(a[2]));
}

/// A hinge's edge and the normals of its triangles.
template <class T>
struct Fold {
  Hinge<T> x;                     ///< x0, x1, o0, o1 [m]
  Triple<T> edge, first, second;  ///< x1 − x0 [m], and the normals of both triangles [m²]
  explicit Fold(const Hinge<T>& at)
      : x(at), edge(x[1] - x[0]), first(cross(edge, x[2] - x[0])), second(cross(x[3] - x[0], edge)) {}
  /// Returns whether the edge or a triangle is degenerate; the angle is then undefined. Over SIMD lanes, returns one
  /// value for each lane.
  auto collapsed() const { return is_zero(first) || is_zero(second); }
  /// Returns whether a kernel may treat the hinge as collapsed (compare/stages/bending.hpp).
  bool may_count_as_collapsed() const { return is_needle(first, x[2]) || is_needle(second, x[3]); }
  /// Returns whether the sine of a triangle's angle at an end of the edge is below bending_needle · 2⁻²⁴. Tests the end
  /// that is farther from the opposite vertex, because the sine is smaller there.
  bool is_needle(const Triple<T>& normal, const Triple<T>& opposite) const {
    const double side = std::max(plain_length(opposite - x[0]), plain_length(opposite - x[1]));
    return plain_length(normal) < compare::bending_needle * compare::unit_roundoff * plain_length(edge) * side;
  }
  /// Returns the angle from the first normal to the second, about the edge.
  T angle() const {
    using std::atan2, std::sqrt;
    return atan2(dot(cross(first, second), edge) / sqrt(dot(edge, edge)), dot(first, second));
  }
};

}  // namespace ogc::reference
