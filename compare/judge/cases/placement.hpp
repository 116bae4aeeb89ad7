// Takes points from a canonical frame to a case. In the canonical frame a degeneracy can be approached by 10⁻¹²,
// because the coordinate that carries it lies near 0. Exact symmetries come first (signed permutations and powers of
// two keep every bit); in half of the cases a rotation follows, whose rounding is one more rung.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "compare/judge/cases/random.hpp"
#include "compare/problem/vector.hpp"

namespace ogc::compare::placement {

/// Return a + b, s a, and a rounded to single precision.
inline Vec3 sum(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 scaled(const Vec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3f single(const Vec3& a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

/// Returns the next larger number.
inline float up(float x) { return std::nextafter(x, std::numeric_limits<float>::infinity()); }
/// Returns x itself, one of its neighbours, or x (1 + rung).
float beside(Random& random, float x);
/// Returns a point of the box [low, high)³.
Vec3 in_box(Random& random, double low, double high);
/// Returns small integers, halves or quarters, so that exact ties are common.
Vec3 on_lattice(Random& random, int extent);
/// Return four points for both pair stages: in the unit box; of any bits; on a lattice that is scaled exactly, by 1,
/// 2^±10 or 2^±18.
std::array<Vec3, 4> points_in_box(Random& random);
std::array<Vec3, 4> points_of_bits(Random& random);
std::array<Vec3, 4> points_on_lattice(Random& random, int extent);
/// Applies one of the 48 symmetries of the cube to all points.
void permute(Random& random, std::span<Vec3> points);
/// Applies one rotation by a random axis and angle to all points, then a shift within the unit box.
void rotate(Random& random, std::span<Vec3> points);
/// Permutes the points; rotates them in half of the cases (in all fine ones, as a coordinate near 0 has no error that
/// could matter); then scales them by 1, 2^±10 or 1000.
void place(Random& random, std::span<Vec3> points);

}  // namespace ogc::compare::placement
