#include "reference/definitions/tet_walk.hpp"

#include <algorithm>

namespace ogc::reference {
namespace {

Rational volume(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c, const RationalPoint& d) {
  return dot(cross(b - a, c - a), d - a);
}

RationalPoint between(const RationalPoint& a, const RationalPoint& b, const Rational& t) {
  const RationalPoint e = b - a;
  return {a.x + t * e.x, a.y + t * e.y, a.z + t * e.z};
}

RationalPoint closest_on_segment(const RationalPoint& a, const RationalPoint& b, const RationalPoint& x) {
  const Rational t = dot(x - a, b - a) / dot(b - a, b - a);
  return between(a, b, std::clamp(t, Rational(0), Rational(1)));
}

/// Keeps the part of the stretch on which a value is ≥ 0. The value changes linearly from `from` (at 0) to `to` (at 1).
/// Returns false if nothing is left.
bool clip(Stretch& stretch, const Rational& from, const Rational& to) {
  const Rational slope = to - from;
  if (slope == 0) return from >= 0;
  const Rational root = -from / slope;
  if (slope > 0) {
    stretch.low = std::max(stretch.low, root);
  } else {
    stretch.high = std::min(stretch.high, root);
  }
  return stretch.low <= stretch.high;
}

}  // namespace

RationalPoint rational(const Vec3f& x) {
  return {Rational(static_cast<double>(x.x)), Rational(static_cast<double>(x.y)), Rational(static_cast<double>(x.z))};
}

std::array<RationalPoint, 4> corners_of(std::span<const Vec3f> positions, const Tetrahedron& t) {
  const auto corner = [&](std::size_t k) { return rational(positions[static_cast<std::size_t>(t[k])]); };
  return {corner(0), corner(1), corner(2), corner(3)};
}

std::array<Rational, 4> weights(const std::array<RationalPoint, 4>& c, const RationalPoint& x) {
  return {volume(x, c[1], c[2], c[3]), volume(c[0], x, c[2], c[3]), volume(c[0], c[1], x, c[3]),
          volume(c[0], c[1], c[2], x)};
}

RationalPoint closest_point(const std::array<RationalPoint, 3>& corners, const RationalPoint& x) {
  const auto& [a, b, c] = corners;
  const RationalPoint n = cross(b - a, c - a);
  bool above = true;
  for (std::size_t k = 0; k < 3; ++k)
    above = above && dot(cross(corners[(k + 1) % 3] - corners[k], x - corners[k]), n) >= 0;
  if (above) {
    const Rational height = dot(n, x - a) / dot(n, n);
    return {x.x - height * n.x, x.y - height * n.y, x.z - height * n.z};
  }
  const std::array<RationalPoint, 3> candidates{closest_on_segment(a, b, x), closest_on_segment(b, c, x),
                                                closest_on_segment(c, a, x)};
  return *std::min_element(candidates.begin(), candidates.end(), [&](const RationalPoint& p, const RationalPoint& q) {
    return squared_distance(p, x) < squared_distance(q, x);
  });
}

Rational squared_distance(const RationalPoint& a, const RationalPoint& b) { return dot(b - a, b - a); }

std::optional<Stretch> Crossing::within(const std::array<bool, 4>& marked) const {
  Stretch stretch;
  for (std::size_t k = 0; k < 4; ++k) {
    if (!clip(stretch, at_start_[k], at_end_[k])) return std::nullopt;
    if (!marked[k] && !clip(stretch, -at_start_[k], -at_end_[k])) return std::nullopt;
  }
  return stretch;
}

}  // namespace ogc::reference
