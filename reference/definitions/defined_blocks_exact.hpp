// Eq. 7 for points that are quotients, for the .cpp files of this room (it shows CGAL's number type).
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

/// Nothing where the foot is not in the interior of the face, or the face has none.
std::optional<Connection> connection(const Complex& mesh, Face face, const ExactPoint& x);

/// Whether d = r is inside.
enum class Sphere { closed, open };

/// The cones of normals of all faces of a mesh.
struct DefinedBlocks::Cones {
  Complex mesh;                                        ///< whose faces they are
  std::vector<NormalCone> vertices, edges, triangles;  ///< by number of the face

  /// N_a of one face.
  const NormalCone& of(Face face) const;
  bool contains(Face face, const ExactPoint& x, float contact_radius, Sphere boundary) const;
  /// In M^e a vertex has the same neighbours as in M, and every perpendicular of an edge is a normal.
  bool contains_edge_only(Face face, const ExactPoint& x, float contact_radius) const;
};

}  // namespace ogc::reference
