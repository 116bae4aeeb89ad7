// The volumetric variant of §3.9, outside the body: blocks of a closed surface that extend outward only, and an exact
// test whether a point is inside.
#pragma once

#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// The location of a point. A surface that passes through itself covers some places more than once.
struct PointLocation {
  bool on_surface = false;  ///< exactly on a triangle
  /// How often the surface winds around the point, counted with the orientation; 0 on the surface, where it jumps.
  int winding = 0;
  /// Winding numbers of either sign count as inside.
  bool inside() const { return !on_surface && winding != 0; }
  bool outside() const { return !on_surface && winding == 0; }
};

/// Returns whether the way from a face of an oriented surface to x begins on the outside; the point of the surface
/// closest to x must lie in the face's interior. From a triangle it does on the side of the normal; from an edge where
/// its triangles meet at less than π inside; from a vertex like from an edge or triangle on the rim of its normals.
/// Points of the face itself are outward (closed). An edge of one triangle and its ends (a rim) have no inner side: all
/// ways begin outside, as where two triangles lie folded onto each other. Each edge must have one triangle, or two that
/// run through it in opposite senses, and no triangle may be without area. For other x the answer has no meaning.
bool begins_outside(const Complex& mesh, Face face, const Vec3f& x);

/// A surface that encloses a volume: each edge has two triangles that run through it in opposite senses, no triangle is
/// without area, no two lie folded onto each other, and the enclosed volume (by the divergence theorem, cavities and
/// overlaps counted with their signs) is positive, so that the triangles' normals point outward. It may pass through
/// itself. Everything is decided without rounding; what the mesh views must outlive this.
class ClosedSurface {
 public:
  /// Throws compare::InputError, with the first edge or triangle that breaks these conditions.
  explicit ClosedSurface(const Complex& mesh);

  /// Returns begins_outside: x in U_a without its distance (Eq. 8–10).
  bool outward(Face face, const Vec3f& x) const;

  /// Checks whether x ∈ U_a, closed at r and closed at the surface, with only the outward half of a triangle or flat
  /// neighbourhood and only the points of the face at reentrant edges and vertices (§3.9).
  bool in_outward_block(Face face, const Vec3f& x, float contact_radius) const;

  /// Locates x by the signed crossings of a ray with the direction (1, ε, ε²) for a vanishing ε: it meets no edge, so
  /// there are no special points.
  PointLocation locate(const Vec3f& x) const;

  /// Returns the surface.
  const Complex& mesh() const { return mesh_; }

 private:
  Complex mesh_;
};

}  // namespace ogc::reference
