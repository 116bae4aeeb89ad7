// Moves meshes whose coordinates are large against their size, as in surveys and city models, near the origin: single
// precision would bend their edges. Coordinates are taken relative to a point near the mesh.
#pragma once

#include <string>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Returns a point near the centre of the positions' bounding box. A coordinate of it is not 0 where the box's centre
/// lies at least 16 times the box's length from 0; there it is a multiple of the largest power of two that is not above
/// that length, so that differences from it are exact in double. For positions that are not finite the point is 0.
/// Single precision keeps at least 20 bits of the length where it is 0, and 23 relative to such a point.
Vec3 local_origin(const std::vector<Vec3>& positions);

/// Returns x − o of all positions [m].
std::vector<Vec3> relative_to(const Vec3& origin, std::vector<Vec3> positions);

/// Returns the double with the fewest decimal digits whose distance from `origin` rounds to `local` in single
/// precision: the number that stood in the file from which `local` was read.
double typed_at(double origin, float local);

/// Returns local positions as coordinates of the file; unchanged if `origin` is 0.
std::vector<Vec3> in_file(const Vec3& origin, const std::vector<Vec3f>& local);

/// Returns "coordinates lie 5e+06 m from 0, 1e+05 times the mesh's size; REMEDY" for a mesh with that origin, as a note
/// for the user; empty if the origin is 0.
std::string describe_origin(const std::vector<Vec3>& positions, const Vec3& origin, const std::string& remedy);

}  // namespace ogc::compare
