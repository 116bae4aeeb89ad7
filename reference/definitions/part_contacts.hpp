// Defines the contacts with a volume of triangles (§3.9). Each part of its surface is tested separately. A part
// contains a point if the point is in the part's box and on the inner side of the nearest face. So a part may have open
// rims, and parts may overlap.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// One contact of a point x with a part; c is the point of `face` closest to x.
struct PartContact {
  bool inside = false;              ///< whether x is inside the part
  Index triangle = -1;              ///< the triangle with the lowest index that contains `face`
  Face face;                        ///< the face whose interior holds c
  std::array<double, 3> weights{};  ///< weights of c, by corner of `triangle`; each within 1 ulp
  /// Unit vector out of the part: (x − c)/‖x − c‖ outside, (c − x)/‖x − c‖ inside. For x = c, and for the interior of a
  /// triangle, it is the triangle's normal.
  compare::Vec3 direction;
  double depth = 0;  ///< ‖x − c‖ + r inside, r − ‖x − c‖ outside [m], within 2 ulp
};

/// Returns the contact of x at a face; `inside`: whether the part holds x.
PartContact part_contact(const Complex& volume, Face face, const Vec3f& x, float contact_radius, bool inside);

/// Returns whether x lies in the closed bounding box of these triangles.
bool in_box_of(const Complex& volume, const std::vector<Index>& triangles, const Vec3f& x);

/// Returns the face of a triangle whose interior holds the triangle's closest point to x.
Face closest_face_of(const Complex& volume, Index triangle, const Vec3f& x);

/// Returns the contacts of x with all parts of a volume, sorted by `inside`, `triangle` and `face`. `part` holds for
/// each vertex the number of its part; if it is empty, the parts are the connected components. Each edge must have one
/// triangle, or two that run through it in opposite senses. Each triangle must have an area.
///
/// A part holds x if x is in the part's box and the segment from the nearest face to x begins on the inner side
/// (begins_outside). If several faces are equally near, the face of the lowest dimension decides, then the lowest
/// index. A part that holds x gives one contact, at the nearest face. Any other part gives one contact for each face
/// whose outward block holds x nearer than r.
std::vector<PartContact> part_contacts(const Complex& volume, const Vec3f& x, float contact_radius,
                                       std::span<const Index> part = {});

}  // namespace ogc::reference
