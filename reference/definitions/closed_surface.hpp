// The volumetric variant of §3.9, outside the body: blocks of a closed surface that go outward only, and the exact
// answer to what is inside.
#pragma once

#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// Where a point lies. A surface that passes through itself covers some places more than once.
struct PointLocation {
  bool on_surface = false;  ///< exactly on a triangle
  /// how often the surface winds around the point, counted with the orientation; 0 on the surface, where it jumps
  int winding = 0;
  /// Winding numbers of either sign count as inside.
  bool inside() const { return !on_surface && winding != 0; }
  bool outside() const { return !on_surface && winding == 0; }
};

/// Whether the way from a face of an oriented surface to x, whose closest point on it lies in the face's interior,
/// begins on the outside. A triangle's does on the side of its normal; an edge's where its triangles meet at less than
/// π inside; a vertex' as that of an edge or triangle on the rim of its normals. The points of the face itself are
/// outward (closed). An edge of one triangle and its ends (a rim) have no inner side: all begins outside, as where two
/// triangles lie folded onto each other. Each edge has one triangle, or two that run through it in opposite senses, and
/// no triangle is without area. For other x the answer has no meaning.
bool begins_outside(const Complex& mesh, Face face, const Vec3f& x);

/// A surface that bounds something: each edge has two triangles that run through it in opposite senses, no triangle is
/// without area, no two lie folded onto each other, and the volume that it encloses (by the divergence theorem,
/// cavities and overlaps counted with their signs) is positive, so that the triangles' normals point outward. It may
/// pass through itself. Everything is decided without rounding; what the mesh views must outlive it.
class ClosedSurface {
 public:
  /// Throws compare::InputError, naming the first edge or triangle that breaks the above.
  explicit ClosedSurface(const Complex& mesh);

  /// x in U_a without its distance (Eq. 8–10): begins_outside.
  bool outward(Face face, const Vec3f& x) const;

  /// x ∈ U_a, closed at r and closed at the surface, with only the outward half of a triangle or flat neighbourhood and
  /// nothing but the points of the face at reentrant edges and vertices (§3.9).
  bool in_outward_block(Face face, const Vec3f& x, float contact_radius) const;

  /// By the signed crossings of a ray whose direction is (1, ε, ε²) for a vanishing ε: no direction meets an edge, and
  /// no point is an exception.
  PointLocation locate(const Vec3f& x) const;

  /// The surface itself.
  const Complex& mesh() const { return mesh_; }

 private:
  Complex mesh_;
};

}  // namespace ogc::reference
