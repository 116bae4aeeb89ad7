// Applies Eq. 7 to points that are fractions. Only .cpp files of this folder include this header, because it exposes
// CGAL's number type.
#pragma once

#include <optional>
#include <vector>

#include "reference/definitions/defined_blocks.hpp"
#include "reference/definitions/normal_cone.hpp"

namespace ogc::reference {

/// The vector x − y from the foot y of x on a face, times a positive weight.
struct Connection {
  ExactVector along;  ///< (x − y) · weight
  Exact weight;       ///< > 0
};

/// Returns the vector from the foot of x on a face to x; empty if the foot is not in the interior of the face, or the
/// face has no interior.
std::optional<Connection> connection(const Complex& mesh, Face face, const ExactPoint& x);

/// Selects whether points at d = r are inside.
enum class Sphere { closed, open };

/// The cones of normals of all faces of a mesh.
struct DefinedBlocks::Cones {
  Complex mesh;
  std::vector<NormalCone> vertices, edges, triangles;  ///< by index of the face

  /// Returns N_a of one face.
  const NormalCone& of(Face face) const;
  bool contains(Face face, const ExactPoint& x, float contact_radius, Sphere boundary) const;
  /// Checks whether x is in the face's block of the edge-only manifold (§3.5). On this manifold a vertex has the same
  /// neighbours as on the surface, and every vector perpendicular to an edge is one of the edge's normals.
  bool contains_edge_only(Face face, const ExactPoint& x, float contact_radius) const;
};

}  // namespace ogc::reference
