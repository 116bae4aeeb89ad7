// A margin is a polynomial in given coordinates whose sign decides something. Its sign is exact. Whether it is grey,
// and its sensitivity to the coordinates, come from the same formula. CGAL stays behind this header.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::reference {

using compare::Vec3f;

/// Names a formula of formulas.hpp. A gap is numerator − r² · denominator of a squared distance, < 0 where the distance
/// is smaller than r.
enum class MarginKind : std::uint8_t { along, side, turn, parallel, gap_points, gap_line, gap_plane, gap_lines };

/// A formula with its points; the coordinates δ of the grey zone are relative to the first one.
struct Margin {
  MarginKind kind = MarginKind::along;  ///< which formula
  std::array<Vec3f, 4> at{};            ///< its points [m]; unused ones are 0
  float radius = 0;                     ///< r of a gap [m]
};

/// Returns how far p is along the edge from a to b.
inline Margin along(const Vec3f& a, const Vec3f& b, const Vec3f& p) { return {MarginKind::along, {a, b, p}}; }
/// Returns on which side of the edge ab, in the plane of abc, p is.
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

/// Returns the same gap for another radius [m].
inline Margin with_radius(Margin gap, float radius) {
  gap.radius = radius;
  return gap;
}

/// All that a decision needs of a margin.
struct MarginAnswer {
  int sign = 0;                 ///< exact: −1, 0 or 1
  bool grey = false;            ///< the result of grey(margin)
  bool near = false;            ///< |m| ≤ 2¹¹ u Σ|∂m/∂δᵢ||δᵢ| (compare::near_factor)
  double value = 0, error = 0;  ///< m in double, and its largest error
};

/// Examines a margin. Coordinates must be finite.
MarginAnswer examine(const Margin& margin);

/// Returns the exact sign: −1, 0 or 1. Coordinates must be finite.
int sign(const Margin& margin);

/// Returns Σ|∂m/∂δᵢ||δᵢ|, δᵢ the coordinates relative to the first point; the radius carries no derivative.
double sensitivity(const Margin& margin);

/// Returns whether 0 < 16 u Σ|∂m/∂δᵢ||δᵢ| ≥ |m| (method.md §2.5); the radius is given and carries no derivative. Where
/// the sum is 0 no relative change of the δᵢ changes the margin's sign, so there is no other side: a vertex straight
/// above a vertex of an axis-parallel grid is not grey.
bool grey(const Margin& margin);

/// Returns the distance of a gap [m], within 1 ulp of double. The denominator must be positive.
double distance(const Margin& gap);

/// Returns the largest single-precision number that is not above the distance of the gap [m]. The denominator must be
/// positive.
float distance_below(const Margin& gap);

/// Both distances of a gap, computed together and faster; the distance is only within 2⁻⁴⁰ max(d, Σ|δᵢ|).
struct GapDistance {
  double distance = 0;  ///< [m]
  float below = 0;      ///< the result of distance_below [m]
};
/// Returns both distances of a gap.
GapDistance measure(const Margin& gap);

/// Returns whether scale · d < b for the distance d of the gap, exactly; scale, b ≥ 0. The denominator must be
/// positive.
bool scaled_distance_less(const Margin& gap, float scale, float b);

/// Returns −1, 0 or 1: the distance of `a` is smaller than, equal to, or larger than that of `b`, exactly. The
/// denominators must be positive.
int compare_distances(const Margin& a, const Margin& b);

/// Returns (scale · d)² [m²] for the distance d of the gap, as a fraction in lowest terms: "num/den". The denominator
/// must be positive.
std::string squared_distance(const Margin& gap, float scale = 1);

/// Returns the margin as a length [m] with its sign, within 1 ulp of double: for `along` and `side` the distance of the
/// last point from the plane, for a gap d − r (without cancellation). Returns 0 where the line or plane is not defined.
/// Throws std::logic_error for `turn` and `parallel`, which are no lengths.
double signed_length(const Margin& margin);

/// Returns m_k / Σ m_j for margins that are no gaps and whose exact sum is positive; each within 1 ulp of double.
std::vector<double> shares(std::span<const Margin> margins);

}  // namespace ogc::reference
