// Relates a segment to one tetrahedron in rational numbers, for the walk of tet_volume.cpp.
#pragma once

#include <CGAL/Exact_rational.h>

#include <optional>

#include "reference/definitions/tet_volume.hpp"
#include "reference/geometry/formulas.hpp"

namespace ogc::reference {

/// The number type of the walk.
using Rational = CGAL::Exact_rational;
using RationalPoint = Point<Rational>;

/// Converts a point without rounding.
RationalPoint rational(const Vec3f& x);

/// Returns the corners of a tetrahedron, in the order of its vertices.
std::array<RationalPoint, 4> corners_of(std::span<const Vec3f> positions, const Tetrahedron& tetrahedron);

/// Returns 6V times the barycentric weights of x, where V is the volume; their sum is 6V.
std::array<Rational, 4> weights(const std::array<RationalPoint, 4>& corners, const RationalPoint& x);

/// Returns the closest point of a triangle with positive area.
RationalPoint closest_point(const std::array<RationalPoint, 3>& corners, const RationalPoint& x);

/// Returns ‖a − b‖² [m²].
Rational squared_distance(const RationalPoint& a, const RationalPoint& b);

/// A closed interval of a segment's parameter.
struct Stretch {
  Rational low = 0, high = 1;
};

/// A segment relative to one tetrahedron; the weights are affine in the segment's parameter.
class Crossing {
 public:
  Crossing(const std::array<RationalPoint, 4>& corners, const RationalPoint& start, const RationalPoint& end)
      : at_start_(weights(corners, start)), at_end_(weights(corners, end)) {}

  /// Returns the part of the segment that lies in a closed face of the tetrahedron. `marked` marks the corners of this
  /// face; if all four corners are marked, the face is the tetrahedron itself.
  std::optional<Stretch> within(const std::array<bool, 4>& marked) const;

 private:
  std::array<Rational, 4> at_start_, at_end_;
};

}  // namespace ogc::reference
