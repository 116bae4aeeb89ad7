// A margin is a polynomial in given coordinates whose sign decides something. Its sign is exact; whether it lies in the
// grey zone and what its neighbours weigh comes from the same formula. CGAL stays behind this header.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::reference {

using compare::Vec3f;

/// Which formula of formulas.hpp; a gap is numerator − r² · denominator of a squared distance, < 0 where it is smaller
/// than r.
enum class MarginKind : std::uint8_t { along, side, turn, parallel, gap_points, gap_line, gap_plane, gap_lines };

/// A formula with its points; the first is the one to which the coordinates δ of the grey zone are relative.
struct Margin {
  MarginKind kind = MarginKind::along;  ///< which formula
  std::array<Vec3f, 4> at{};            ///< its points [m]; what it lacks is 0
  float radius = 0;                     ///< r of a gap [m]
};

/// How far p is along the edge from a to b.
inline Margin along(const Vec3f& a, const Vec3f& b, const Vec3f& p) { return {MarginKind::along, {a, b, p}}; }
/// On which side of the edge ab, in the plane of abc, p is.
inline Margin side(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& p) {
  return {MarginKind::side, {a, b, c, p}};
}
inline Margin turn(const Vec3f& p, const Vec3f& x, const Vec3f& q0, const Vec3f& q1) {
  return {MarginKind::turn, {p, x, q0, q1}};
}
inline Margin parallel(const Vec3f& p0, const Vec3f& p1, const Vec3f& q0, const Vec3f& q1) {
  return {MarginKind::parallel, {p0, p1, q0, q1}};
}
/// d² − r² of two points.
inline Margin gap_points(const Vec3f& a, const Vec3f& p, float radius = 0) {
  return {MarginKind::gap_points, {a, p}, radius};
}
/// d² − r² of p and the line ab.
inline Margin gap_line(const Vec3f& a, const Vec3f& b, const Vec3f& p, float radius = 0) {
  return {MarginKind::gap_line, {a, b, p}, radius};
}
/// d² − r² of p and the plane abc.
inline Margin gap_plane(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& p, float radius = 0) {
  return {MarginKind::gap_plane, {a, b, c, p}, radius};
}
/// d² − r² of two lines.
inline Margin gap_lines(const Vec3f& p0, const Vec3f& p1, const Vec3f& q0, const Vec3f& q1, float radius = 0) {
  return {MarginKind::gap_lines, {p0, p1, q0, q1}, radius};
}

/// The same gap about another radius [m].
inline Margin with_radius(Margin gap, float radius) {
  gap.radius = radius;
  return gap;
}

/// All that a decision asks of a margin.
struct MarginAnswer {
  int sign = 0;                 ///< exact: −1, 0 or 1
  bool grey = false;            ///< as below
  bool near = false;            ///< |m| ≤ 2¹¹ u Σ|∂m/∂δᵢ||δᵢ| (compare::near_factor)
  double value = 0, error = 0;  ///< m in double, and how far off that is at most
};

/// Coordinates must be finite.
MarginAnswer examine(const Margin& margin);

/// Exact sign: −1, 0 or 1. Coordinates must be finite.
int sign(const Margin& margin);

/// Σ|∂m/∂δᵢ||δᵢ|, δᵢ the coordinates relative to the first point; the radius carries no derivative.
double sensitivity(const Margin& margin);

/// 0 < 16 u Σ|∂m/∂δᵢ||δᵢ| ≥ |m| (method.md §2.5); the radius is given and carries no derivative. Where the sum is 0 no
/// relative change of the δᵢ moves the margin off its sign, so there is no other side: a vertex straight above a vertex
/// of an axis-parallel grid is not grey.
bool grey(const Margin& margin);

/// Distance of a gap [m], within 1 ulp of double. The denominator must be positive.
double distance(const Margin& gap);

/// The largest single-precision number that is not above the distance of the gap [m]. Denominator as above.
float distance_below(const Margin& gap);

/// Both at once, faster; the distance within 2⁻⁴⁰ max(d, Σ|δᵢ|) only.
struct GapDistance {
  double distance = 0;  ///< [m]
  float below = 0;      ///< [m], as distance_below
};
/// Both distances of a gap.
GapDistance measure(const Margin& gap);

/// scale · d < b for the distance d of the gap, exactly; scale, b ≥ 0. Denominator as above.
bool scaled_distance_less(const Margin& gap, float scale, float b);

/// −1, 0 or 1: the distance of `a` is smaller than, as large as, larger than that of `b`, exactly. Denominators as
/// above.
int compare_distances(const Margin& a, const Margin& b);

/// (scale · d)² [m²] for the distance d of the gap, as a fraction in lowest terms: "num/den". Denominator as above.
std::string squared_distance(const Margin& gap, float scale = 1);

/// The margin as a length [m] with its sign, within 1 ulp of double: of `along` and `side` the distance of the last
/// point from the plane, of a gap d − r (without cancellation). 0 where the line or plane is not defined. Not for
/// `turn` and `parallel`, which are no lengths: std::logic_error.
double signed_length(const Margin& margin);

/// m_k / Σ m_j for margins that are no gaps and whose exact sum is positive; within 1 ulp of double each.
std::vector<double> shares(std::span<const Margin> margins);

}  // namespace ogc::reference
