// Meshes whose coordinates are large against their size, as surveys and city models have them: single precision would
// bend their edges, so that they are taken relative to a point near them.
#pragma once

#include <string>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Where positions lie 16 times as far from 0 as their bounding box is long, or farther, a point near its centre: in
/// each coordinate that is so, a multiple of the largest power of two below that length, so that differences from it
/// are exact in double. Otherwise, and for positions that are not finite, 0. Single precision keeps at least 20 bits of
/// the length where it is 0, and 23 relative to such a point.
Vec3 local_origin(const std::vector<Vec3>& positions);

/// Positions relative to a point: x − o [m].
std::vector<Vec3> relative_to(const Vec3& origin, std::vector<Vec3> positions);

/// The double with the fewest decimal digits whose distance from `origin` rounds to `local` in single precision: what a
/// file had there that was read relative to `origin`.
double typed_at(double origin, float local);

/// Local positions as the file's coordinates; where `origin` is 0 as they are.
std::vector<Vec3> in_file(const Vec3& origin, const std::vector<Vec3f>& local);

/// "coordinates lie 5e+06 m from 0, 1e+05 times the mesh's size; REMEDY" of a mesh with that origin: what a user should
/// know. Empty where it is 0.
std::string describe_origin(const std::vector<Vec3>& positions, const Vec3& origin, const std::string& remedy);

}  // namespace ogc::compare
