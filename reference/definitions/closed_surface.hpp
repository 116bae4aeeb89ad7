// Implements the volumetric variant of §3.9 outside the body: blocks of a closed surface that extend outward only, and
// an exact test whether a point is inside.
#pragma once

#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// Describes where a point lies relative to a surface. The surface may pass through itself.
struct PointLocation {
  bool on_surface = false;  ///< exactly on a triangle
  /// signed number of times that the surface winds around the point; 0 on the surface
  int winding = 0;
  /// Returns whether the winding number is not 0.
  bool inside() const { return !on_surface && winding != 0; }
  bool outside() const { return !on_surface && winding == 0; }
};

/// Returns whether the segment from a face of an oriented surface to x begins on the outside. The face's interior must
/// hold the surface's closest point to x; for other x the result has no meaning. Each edge must have one triangle, or
/// two that run through it in opposite senses. Each triangle must have an area. The segment begins outside
///
///   - a triangle, if x is on the side of the triangle's normal or on the triangle,
///   - an edge, if the angle between its triangles is less than π inside (a flat edge: as for a triangle),
///   - a vertex, if it begins outside an edge at the vertex that is perpendicular to one of the vertex's normals,
///   - a rim (an edge with one triangle, or an end of this edge) and triangles that are folded onto each other, always.
///
/// Points of the face itself are outside.
bool begins_outside(const Complex& mesh, Face face, const Vec3f& x);

/// A surface that encloses a volume: each edge has two triangles that run through it in opposite senses, each triangle
/// has an area, and no two are folded onto each other. The enclosed volume (divergence theorem, with signs) is
/// positive, so normals point outward. The surface may pass through itself. Decides without rounding. Holds views;
/// their owners must outlive this.
class ClosedSurface {
 public:
  /// Throws compare::InputError with the first edge or triangle that does not meet these requirements.
  explicit ClosedSurface(const Complex& mesh);

  /// Returns begins_outside(mesh(), face, x); x must satisfy all conditions of U_a except the distance (Eq. 8–10).
  bool outward(Face face, const Vec3f& x) const;

  /// Checks whether x is in the outward part of U_a (§3.9), closed at r and at the surface. The outward part of a
  /// triangle's block, or of a block in a flat neighbourhood, is its outward half. The outward part of a reentrant edge
  /// or vertex holds only the face itself.
  bool in_outward_block(Face face, const Vec3f& x, float contact_radius) const;

  /// Locates x by the signed crossings of a ray with the direction (1, ε, ε²), ε → 0. The ray meets no edge, so no
  /// point needs a special case.
  PointLocation locate(const Vec3f& x) const;

  /// Returns the surface.
  const Complex& mesh() const { return mesh_; }

 private:
  Complex mesh_;
};

}  // namespace ogc::reference
