// The parts of mesh validation that a scene needs twice: for its start positions and for its rest positions.
#pragma once

#include <string>
#include <vector>

#include "compare/problem/validate.hpp"

namespace ogc::compare {

inline constexpr double least_length = 0x1p-20;  ///< [m] of an edge (method.md §2.4)
inline constexpr double most_length = 0x1p20;    ///< [m] of an edge, and of a coordinate

/// What is checked, what its elements are called, and where problems go: at most `limit` of each kind, then a count.
struct MeshCheck {
  const Mesh& mesh;                ///< what is looked at
  const ElementNames& names;       ///< what its elements are called
  std::size_t limit;               ///< of each kind
  std::vector<Problem>& problems;  ///< where they go
};

/// Whether all faces name existing, distinct vertices; lists those that do not.
bool check_indices(const MeshCheck& check);

/// Coordinates, edge lengths and areas of the mesh's faces on `positions`; indices are valid. `kind` stands before the
/// nouns: "" or "rest ".
void check_positions(const MeshCheck& check, const std::vector<Vec3>& positions, const std::string& kind);

/// Faces that more than two tetrahedra have, or two on one side, and tetrahedra that stand twice; indices are valid.
void check_tetrahedra(const MeshCheck& check);

/// Tetrahedra that are inverted at their rest positions, decided exactly, or flat: without volume, or with so little
/// that their rest data are beyond the limits of compare/stages/tetrahedron.hpp. Positions are numbers of single
/// precision, indices are valid.
void check_volumes(const MeshCheck& check, const std::vector<Vec3>& rest_positions);

/// Whether all three coordinates are finite.
bool is_finite(const Vec3& v);

/// "(x, y, z)".
std::string printed(const Vec3& v);

}  // namespace ogc::compare
