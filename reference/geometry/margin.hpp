// A margin is a polynomial in given coordinates; its sign decides a predicate. This header gives the exact sign,
// whether rounding of the inputs could change it (grey), and the sensitivity to the coordinates. It hides CGAL.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::reference {

using compare::Vec3f;

/// Names a formula of formulas.hpp. For a squared distance d² = p/q, the gap is p − r² q, which has the sign of d² −
/// r².
enum class MarginKind : std::uint8_t { along, side, turn, parallel, gap_points, gap_line, gap_plane, gap_lines };

/// A formula and its points. The coordinates δ of the grey zone are relative to the first point.
struct Margin {
  MarginKind kind = MarginKind::along;  ///< which formula
  std::array<Vec3f, 4> at{};            ///< its points [m]; unused ones are 0
  float radius = 0;                     ///< r of a gap [m]
};

/// Returns (p − a)·(b − a): how far p is along the edge from a to b.
inline Margin along(const Vec3f& a, const Vec3f& b, const Vec3f& p) { return {MarginKind::along, {a, b, p}}; }
/// Returns on which side of the line ab p lies, seen perpendicular to abc: > 0 on c's side.
inline Margin side(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& p) {
  return {MarginKind::side, {a, b, c, p}};
}
inline Margin turn(const Vec3f& p, const Vec3f& x, const Vec3f& q0, const Vec3f& q1) {
  return {MarginKind::turn, {p, x, q0, q1}};
}
inline Margin parallel(const Vec3f& p0, const Vec3f& p1, const Vec3f& q0, const Vec3f& q1) {
  return {MarginKind::parallel, {p0, p1, q0, q1}};
}
/// Returns d² − r² of two points.
inline Margin gap_points(const Vec3f& a, const Vec3f& p, float radius = 0) {
  return {MarginKind::gap_points, {a, p}, radius};
}
/// Returns d² − r² of p and the line ab.
inline Margin gap_line(const Vec3f& a, const Vec3f& b, const Vec3f& p, float radius = 0) {
  return {MarginKind::gap_line, {a, b, p}, radius};
}
/// Returns d² − r² of p and the plane abc.
inline Margin gap_plane(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& p, float radius = 0) {
  return {MarginKind::gap_plane, {a, b, c, p}, radius};
}
/// Returns d² − r² of two lines.
inline Margin gap_lines(const Vec3f& p0, const Vec3f& p1, const Vec3f& q0, const Vec3f& q1, float radius = 0) {
  return {MarginKind::gap_lines, {p0, p1, q0, q1}, radius};
}

/// Returns the gap with another radius [m].
inline Margin with_radius(Margin gap, float radius) {
  gap.radius = radius;
  return gap;
}

/// Holds the results that decisions use.
struct MarginAnswer {
  int sign = 0;                 ///< exact: −1, 0 or 1
  bool grey = false;            ///< the result of grey(margin)
  bool near = false;            ///< whether |m| ≤ 2¹¹ · 2⁻²⁴ Σ|∂m/∂δᵢ||δᵢ| (compare::near_factor)
  double value = 0, error = 0;  ///< m in double precision, and an upper limit of its error
};

/// Examines a margin. Coordinates must be finite.
MarginAnswer examine(const Margin& margin);

/// Returns the exact sign: −1, 0 or 1. Coordinates must be finite.
int sign(const Margin& margin);

/// Returns Σ|∂m/∂δᵢ||δᵢ|, where δᵢ are the coordinates relative to the first point. The radius counts as exact.
double sensitivity(const Margin& margin);

/// Returns whether |m| ≤ 16 · 2⁻²⁴ Σ|∂m/∂δᵢ||δᵢ| and the sum is not 0 (method.md §2.5); the radius counts as exact. If
/// the sum is 0, no relative change of the δᵢ changes the sign, so the margin is not grey. An example is a vertex
/// straight above a grid vertex, in an axis-parallel grid.
bool grey(const Margin& margin);

/// Returns the distance of a gap [m], within 1 ulp of double. The denominator must be positive.
double distance(const Margin& gap);

/// Returns the distance of the gap, rounded down to single precision [m]. The denominator must be positive.
float distance_below(const Margin& gap);

/// The distance of a gap, and the distance rounded down. Computing both together is faster, but `distance` then has an
/// error of up to 2⁻⁴⁰ max(d, Σ|δᵢ|).
struct GapDistance {
  double distance = 0;  ///< [m]
  float below = 0;      ///< the result of distance_below [m]
};
/// Returns the distance of a gap, and the distance rounded down.
GapDistance measure(const Margin& gap);

/// Returns whether scale · d < b, exactly, where d is the distance of the gap; scale, b ≥ 0. The denominator must be
/// positive.
bool scaled_distance_less(const Margin& gap, float scale, float b);

/// Returns −1, 0 or 1 if the distance of `a` is smaller than, equal to, or larger than that of `b`, exactly. The
/// denominators must be positive.
int compare_distances(const Margin& a, const Margin& b);

/// Returns (scale · d)² [m²], where d is the distance of the gap, as a fraction in lowest terms: "num/den". The
/// denominator must be positive.
std::string squared_distance(const Margin& gap, float scale = 1);

/// Returns the margin as a signed length [m], within 1 ulp of double: for `along` and `side` the distance of the last
/// point from the plane, for a gap d − r (without cancellation). Returns 0 if the line or plane is not defined. Throws
/// std::logic_error for `turn` and `parallel`, because these margins are not lengths.
double signed_length(const Margin& margin);

/// Returns m_k / Σ m_j for each margin m_k, within 1 ulp of double. The margins must not be gaps, and their exact sum
/// must be positive.
std::vector<double> shares(std::span<const Margin> margins);

}  // namespace ogc::reference
