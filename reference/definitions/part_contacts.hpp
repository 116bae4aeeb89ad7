// §3.9 for a volume of triangles, by definition. Each part of its surface is tested separately, and the side of its
// nearest face alone decides, so that rims need no cap and overlapping parts no common inside.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// One contact of a point x with a part. c is the point of `face` closest to x.
struct PartContact {
  bool inside = false;              ///< whether x is inside the part
  Index triangle = -1;              ///< the lowest-numbered triangle that contains `face`
  Face face;                        ///< the face whose interior holds c
  std::array<double, 3> weights{};  ///< weights of c, by corner of `triangle`; each within 1 ulp
  /// Unit vector out of the part: (x − c)/‖x − c‖ outside, (c − x)/‖x − c‖ inside; where x = c, and on the interior of
  /// a triangle, the triangle's normal.
  compare::Vec3 direction;
  double depth = 0;  ///< ‖x − c‖ + r inside, r − ‖x − c‖ outside [m], within 2 ulp
};

/// Returns the contact of x at a face, for a part that holds x (`inside`) or does not.
PartContact part_contact(const Complex& volume, Face face, const Vec3f& x, float contact_radius, bool inside);

/// Returns whether x lies in the closed box of these triangles' corners.
bool in_box_of(const Complex& volume, const std::vector<Index>& triangles, const Vec3f& x);

/// Returns the face of a triangle whose interior holds the point of the triangle closest to x.
Face closest_face_of(const Complex& volume, Index triangle, const Vec3f& x);

/// Returns the contacts of x with all parts of a volume, ascending by inside, triangle, face. A part holds x if the way
/// from its nearest face to x begins on the inner side. Of equally near faces the lowest-dimensional, then the
/// lowest-numbered one decides; faces at rims have no inner side, and no point beyond the part's box is inside. A part
/// that holds x gives one contact, at that face; any other part gives one for each face in whose outward block x lies
/// nearer than r. Each edge must have one triangle, or two that run through it in opposite senses, and no triangle may
/// be without area. `part`: by vertex, the number of its part; empty: the connected components.
std::vector<PartContact> part_contacts(const Complex& volume, const Vec3f& x, float contact_radius,
                                       std::span<const Index> part = {});

}  // namespace ogc::reference
