// Measures how deep a point lies inside a block, boundary by boundary: exact signs, and lengths for printing and
// drawing.
#pragma once

#include <vector>

#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// One boundary of a block.
struct BlockMargin {
  /// The kind of boundary.
  enum class Kind : std::uint8_t {
    sphere,  ///< dis(x, a) ≤ r; the length is Eq. 13's penetration depth r − dis(x, a)
    end,     ///< the plane through a vertex, perpendicular to an edge (Eq. 8, 9, 14, 15)
    wall,    ///< the plane through an edge, perpendicular to a triangle (Eq. 9, 10)
  };
  Kind kind = Kind::sphere;  ///< kind of this boundary
  Face across;               ///< the neighbouring face beyond the boundary; for the sphere the face itself
  int sign = 0;              ///< exact: 1 inside, 0 on the boundary, −1 outside
  double length = 0;         ///< distance to the boundary [m] with this sign, within 1 ulp of double
  bool closed = false;       ///< whether the boundary belongs to the block, as the equations print it
  /// Returns whether the point is on the inner side of this boundary; points on the boundary count if it is closed.
  bool holds() const { return sign > 0 || (sign == 0 && closed); }
};

/// Returns all boundaries of U_a (Eq. 8, 9, 10) or, with `edge_only`, of U_a^E (Eq. 14, 15), the sphere first. x is in
/// the block if all of them hold. For an edge the "sphere" is the wall of a cylinder, for a triangle two planes at
/// distance r.
std::vector<BlockMargin> block_margins(const Complex& mesh, Face face, const Vec3f& x, float contact_radius,
                                       bool edge_only = false);

}  // namespace ogc::reference
