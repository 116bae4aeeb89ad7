// Moves meshes near the origin if their coordinates are large compared with their size, as in surveys and city models,
// because single precision would bend their edges. Coordinates are then relative to a point near the mesh.
#pragma once

#include <string>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Returns an origin near the centre of the positions' bounding box. Along an axis it is 0, unless the box's centre is
/// at least 16 times the box's length from 0. Then it is a multiple of the largest power of two that is not above that
/// length, so that differences from it are exact in double. Relative to the origin single precision then resolves the
/// box's length along this axis with 23 bits. Along an axis with origin 0 it resolves the length with at least 20 bits.
/// The origin is 0 for positions that are not finite.
Vec3 local_origin(const std::vector<Vec3>& positions);

/// Returns x − o of all positions [m].
std::vector<Vec3> relative_to(const Vec3& origin, std::vector<Vec3> positions);

/// Returns the double with the fewest decimal digits whose distance from `origin` rounds to `local` in single
/// precision. That is the number that the file contains if its coordinates were written with few digits.
double typed_at(double origin, float local);

/// Returns local positions in the coordinates of the file; unchanged if `origin` is 0.
std::vector<Vec3> in_file(const Vec3& origin, const std::vector<Vec3f>& local);

/// Returns "coordinates lie 5e+06 m from 0, 1e+05 times the mesh's size; REMEDY" for a mesh with that origin, as a note
/// for the user; empty if the origin is 0.
std::string describe_origin(const std::vector<Vec3>& positions, const Vec3& origin, const std::string& remedy);

}  // namespace ogc::compare
