// Moves meshes near the origin if their coordinates are large compared with their size, as in surveys and city models,
// because single precision would bend their edges. Coordinates are then relative to a point near the mesh.
#pragma once

#include <string>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Returns an origin near the centre of the positions' bounding box. Let L be the box's longest side. A coordinate of
/// the origin is 0 if the centre's coordinate is below 16 L in modulus. Otherwise it is a multiple of the largest power
/// of two that is not above L, so that differences from it are exact in double. Relative to this origin single
/// precision resolves L with 23 bits, or with at least 20 bits along an axis on which the origin is 0. The origin is 0
/// for positions that are not finite.
Vec3 local_origin(const std::vector<Vec3>& positions);

/// Returns the positions minus `origin` [m].
std::vector<Vec3> relative_to(const Vec3& origin, std::vector<Vec3> positions);

/// Returns the double with the fewest decimal digits whose distance from `origin` rounds to `local` in single
/// precision. That is the number that the file contains if its coordinates were written with few digits.
double typed_at(double origin, float local);

/// Returns local positions in the coordinates of the file; unchanged if `origin` is 0.
std::vector<Vec3> in_file(const Vec3& origin, const std::vector<Vec3f>& local);

/// Returns "coordinates lie 5e+06 m from 0, 1e+05 times the mesh's size; REMEDY", a note for the user about a mesh with
/// this origin; empty if the origin is 0.
std::string describe_origin(const std::vector<Vec3>& positions, const Vec3& origin, const std::string& remedy);

}  // namespace ogc::compare
