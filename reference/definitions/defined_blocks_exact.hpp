// Eq. 7 for points that are quotients, for the .cpp files of this folder (it exposes CGAL's number type).
#pragma once

#include <optional>
#include <vector>

#include "reference/definitions/defined_blocks.hpp"
#include "reference/definitions/normal_cone.hpp"

namespace ogc::reference {

/// x − y for the foot y of x on a face, times a positive weight.
struct Connection {
  ExactVector along;  ///< (x − y) · weight
  Exact weight;       ///< > 0
};

/// Returns the connection of x and a face; empty where the foot is not in the interior of the face, or the face has no
/// interior.
std::optional<Connection> connection(const Complex& mesh, Face face, const ExactPoint& x);

/// Whether points at d = r are inside.
enum class Sphere { closed, open };

/// The cones of normals of all faces of a mesh.
struct DefinedBlocks::Cones {
  Complex mesh;                                        ///< the mesh of the faces
  std::vector<NormalCone> vertices, edges, triangles;  ///< by number of the face

  /// Returns N_a of one face.
  const NormalCone& of(Face face) const;
  bool contains(Face face, const ExactPoint& x, float contact_radius, Sphere boundary) const;
  /// Checks whether x is in the face's block of M^e. There a vertex has the same neighbours as in M, and every
  /// perpendicular of an edge is a normal.
  bool contains_edge_only(Face face, const ExactPoint& x, float contact_radius) const;
};

}  // namespace ogc::reference
