// Tetrahedra along a segment, in rational numbers, for tet_volume.cpp: the geometry of one tetrahedron that the walk
// needs.
#pragma once

#include <CGAL/Exact_rational.h>

#include <optional>

#include "reference/definitions/tet_volume.hpp"
#include "reference/geometry/formulas.hpp"

namespace ogc::reference {

/// The numbers in which a walk is decided.
using Rational = CGAL::Exact_rational;
using RationalPoint = Point<Rational>;

/// Converts a point without rounding.
RationalPoint rational(const Vec3f& x);

/// Returns the corners of a tetrahedron, in the order of its vertices.
std::array<RationalPoint, 4> corners_of(std::span<const Vec3f> positions, const Tetrahedron& tetrahedron);

/// Returns six times the barycentric weights of x; their sum is six times the volume.
std::array<Rational, 4> weights(const std::array<RationalPoint, 4>& corners, const RationalPoint& x);

/// Returns the closest point of a triangle with positive area.
RationalPoint closest_point(const std::array<RationalPoint, 3>& corners, const RationalPoint& x);

/// Returns ‖a − b‖² [m²].
Rational squared_distance(const RationalPoint& a, const RationalPoint& b);

/// An interval of the parameter of a segment, both ends included.
struct Stretch {
  Rational low = 0, high = 1;
};

/// A segment of space relative to one tetrahedron: weights are affine in the parameter.
class Crossing {
 public:
  Crossing(const std::array<RationalPoint, 4>& corners, const RationalPoint& start, const RationalPoint& end)
      : at_start_(weights(corners, start)), at_end_(weights(corners, end)) {}

  /// Returns where the segment lies in the closed face of the marked corners (all four: in the tetrahedron).
  std::optional<Stretch> within(const std::array<bool, 4>& marked) const;

 private:
  std::array<Rational, 4> at_start_, at_end_;
};

}  // namespace ogc::reference
