// §3.9 for a volume of triangles, by definition: each part of its surface is asked by itself, and answers by the side
// of its nearest face alone, so that rims need no cap and overlapping parts no common inside.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// One contact of a point x with a part. c is the point of `face` closest to x.
struct PartContact {
  bool inside = false;              ///< whether x is inside the part
  Index triangle = -1;              ///< the lowest-numbered one that contains `face`
  Face face;                        ///< whose interior holds c
  std::array<double, 3> weights{};  ///< of c, by corner of `triangle`; within 1 ulp each
  /// unit vector out of the part: (x − c)/‖x − c‖ outside, (c − x)/‖x − c‖ inside; where x = c, and on the interior of
  /// a triangle, the triangle's normal
  compare::Vec3 direction;
  double depth = 0;  ///< ‖x − c‖ + r inside, r − ‖x − c‖ outside [m], within 2 ulp
};

/// The contact of x at a face, as one of a part that holds x or not.
PartContact part_contact(const Complex& volume, Face face, const Vec3f& x, float contact_radius, bool inside);

/// Whether x lies in the closed box of these triangles' corners.
bool in_box_of(const Complex& volume, const std::vector<Index>& triangles, const Vec3f& x);

/// The face of a triangle whose interior holds the point of the triangle closest to x.
Face closest_face_of(const Complex& volume, Index triangle, const Vec3f& x);

/// The contacts of x with all parts of a volume, ascending by inside, triangle, face. A part holds x if the way from
/// its nearest face to x begins on the inner side; of equally near faces the lowest-dimensional, then the
/// lowest-numbered one decides; faces at rims have no inner side, and beyond the part's box nobody is inside. Such a
/// part gives one contact, at that face; any other gives one for each face in whose outward block x lies nearer than r.
/// Each edge has one triangle, or two that run through it in opposite senses, and no triangle is without area. `part`:
/// by vertex, a number of its part; empty: those of the connected components.
std::vector<PartContact> part_contacts(const Complex& volume, const Vec3f& x, float contact_radius,
                                       std::span<const Index> part = {});

}  // namespace ogc::reference
