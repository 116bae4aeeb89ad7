// The parts of mesh validation that a scene needs twice: for its start positions and for its rest positions.
#pragma once

#include <string>
#include <vector>

#include "compare/problem/validate.hpp"

namespace ogc::compare {

inline constexpr double least_length = 0x1p-20;  ///< [m] of a coordinate or length that is not zero (method.md §2)
inline constexpr double most_length = 0x1p20;    ///< [m]

/// Whether all faces name existing, distinct vertices; lists those that do not.
bool check_indices(const Mesh& mesh, std::size_t limit, std::vector<Problem>& problems);

/// Coordinates, edge lengths and areas of the mesh's faces on `positions`; indices are valid. `kind` stands before the nouns: "" or "rest ".
void check_positions(const Mesh& mesh, const std::vector<Vec3>& positions, const std::string& kind, std::size_t limit, std::vector<Problem>& problems);

/// Whether all three coordinates are finite.
bool is_finite(const Vec3& v);

/// "(x, y, z)".
std::string printed(const Vec3& v);

}  // namespace ogc::compare
