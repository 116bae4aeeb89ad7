// Moves points from a canonical frame into a case. In the canonical frame the coordinate that makes the degeneracy lies
// near 0, so a case can be 10⁻¹² from the degeneracy. Exact symmetries come first: signed permutations and powers of
// two keep every bit. In half of the cases a rotation follows; its rounding adds another small deviation.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "compare/judge/cases/random.hpp"
#include "compare/problem/vector.hpp"

namespace ogc::compare::placement {

/// Return a + b, s a, and the rounding of a to single precision.
inline Vec3 sum(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 scaled(const Vec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3f single(const Vec3& a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

/// Returns the next larger number of single precision.
inline float up(float x) { return std::nextafter(x, std::numeric_limits<float>::infinity()); }
/// Returns x itself, the next smaller or larger number, or x (1 + rung).
float beside(Random& random, float x);
/// Returns a point of the box [low, high)³.
Vec3 in_box(Random& random, double low, double high);
/// Returns a point whose coordinates are small integers, halves or quarters, so that exact ties are common.
Vec3 on_lattice(Random& random, int extent);
/// Return four points for closest_face and closest_points: in the unit box; of random bits; on a lattice that is scaled
/// exactly, by 1, 2^±10 or 2^±18.
std::array<Vec3, 4> points_in_box(Random& random);
std::array<Vec3, 4> points_of_bits(Random& random);
std::array<Vec3, 4> points_on_lattice(Random& random, int extent);
/// Applies one of the 48 symmetries of the cube to all points.
void permute(Random& random, std::span<Vec3> points);
/// Applies one rotation by a random axis and angle to all points, then a shift within the unit box.
void rotate(Random& random, std::span<Vec3> points);
/// Permutes the points, rotates them in half of the cases, and scales them by 1, 2^±10 or 1000. Points of a fine case
/// are always rotated: without rotation a coordinate near 0 would be exact, and no decision would be in doubt.
void place(Random& random, std::span<Vec3> points);

}  // namespace ogc::compare::placement
