// Checks a mesh's indices and positions. A scene checks positions twice: at the start and at rest.
#pragma once

#include <string>
#include <vector>

#include "compare/problem/validate.hpp"

namespace ogc::compare {

inline constexpr double least_length = 0x1p-20;  ///< [m] shortest edge (method.md §2.4)
inline constexpr double most_length = 0x1p20;    ///< [m] longest edge, largest coordinate

/// Holds what is checked, the names of its elements, and the list for problems: at most `limit` of each kind, then a
/// count.
struct MeshCheck {
  const Mesh& mesh;                ///< the mesh under test
  const ElementNames& names;       ///< names its elements in messages
  std::size_t limit;               ///< listed problems of each kind
  std::vector<Problem>& problems;  ///< problems are appended here
};

/// Returns whether all faces name existing, distinct vertices; lists those that do not.
bool check_indices(const MeshCheck& check);

/// Lists bad coordinates, edge lengths and areas of the mesh's faces at `positions`; indices must be valid. `kind`
/// precedes the nouns of messages: "" or "rest ".
void check_positions(const MeshCheck& check, const std::vector<Vec3>& positions, const std::string& kind);

/// Lists elements with volume whose rest shape is not allowed; indices must be valid.
void check_volumes(const MeshCheck& check, const std::vector<Vec3>& rest_positions);

/// Returns whether all three coordinates are finite.
bool is_finite(const Vec3& v);

/// Returns "(x, y, z)".
std::string printed(const Vec3& v);

}  // namespace ogc::compare
