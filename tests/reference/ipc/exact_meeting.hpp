// Decides without rounding whether two primitives meet during a straight motion. The four points lie in one plane at
// the roots of a cubic polynomial of time. At a root they meet if polynomials of degree four have the right signs.
// After scaling, all polynomials have integer coefficients in Bernstein form. If the coefficients of a polynomial do
// not change sign, it has no root. Additions alone halve an interval. Halves without a root, or with wrong signs, are
// discarded. An interval that survives all halvings holds a meeting, or a miss by less than 2⁻ᵈᵉᵖᵗʰ of the motion.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <boost/multiprecision/gmp.hpp>

#include "reference/energies/derivative.hpp"

namespace ogc::tests {

using Integer = boost::multiprecision::mpz_int;
/// Bernstein coefficients on the current interval, up to a common positive factor.
using Bernstein = std::vector<Integer>;
using Points4 = std::array<reference::Triple<double>, 4>;

/// Coordinates must be multiples of 2^−exact_bits.
inline constexpr int exact_bits = 100;

inline Integer scaled(double value) {
  int exponent = 0;
  const auto mantissa = static_cast<long long>(std::ldexp(std::frexp(value, &exponent), 53));
  const int shift = exponent - 53 + exact_bits;
  return shift >= 0 ? Integer(Integer(mantissa) << shift) : Integer(Integer(mantissa) >> -shift);
}

/// Bernstein coefficients times binomials. In this form, polynomials multiply like polynomials in powers.
struct Scaled {
  std::vector<Integer> c;  ///< binomial(n, k) · Bernstein coefficient
  friend Scaled operator*(const Scaled& a, const Scaled& b) {
    Scaled r{std::vector<Integer>(a.c.size() + b.c.size() - 1, 0)};
    for (std::size_t i = 0; i < a.c.size(); ++i)
      for (std::size_t j = 0; j < b.c.size(); ++j) r.c[i + j] += a.c[i] * b.c[j];
    return r;
  }
  friend Scaled operator+(Scaled a, const Scaled& b) {
    for (std::size_t i = 0; i < a.c.size(); ++i) a.c[i] += b.c[i];
    return a;
  }
  friend Scaled operator-(Scaled a, const Scaled& b) {
    for (std::size_t i = 0; i < a.c.size(); ++i) a.c[i] -= b.c[i];
    return a;
  }
};
using Vector = std::array<Scaled, 3>;
inline Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector crossed(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Scaled dotted(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Returns the Bernstein coefficients times the least common multiple of the binomials.
inline Bernstein bernstein(const Scaled& p) {
  static const std::array<std::vector<int>, 5> factor{{{1}, {1, 1}, {2, 1, 2}, {3, 1, 1, 3}, {12, 3, 2, 3, 12}}};
  Bernstein b;
  for (std::size_t k = 0; k < p.c.size(); ++k) b.push_back(p.c[k] * factor[p.c.size() - 1][k]);
  return b;
}

inline bool all_positive(const Bernstein& b) {
  for (const Integer& c : b)
    if (c <= 0) return false;
  return true;
}
inline bool all_negative(const Bernstein& b) {
  for (const Integer& c : b)
    if (c >= 0) return false;
  return true;
}

/// Returns the polynomial on both halves of the interval, times 2^degree.
inline std::array<Bernstein, 2> halves(const Bernstein& b) {
  const std::size_t degree = b.size() - 1;
  Bernstein row = b, left{b[0] << degree}, right{b[degree] << degree};
  for (std::size_t level = 1; level <= degree; ++level) {
    for (std::size_t k = 0; k + level <= degree; ++k) row[k] += row[k + 1];
    left.push_back(row[0] << (degree - level));
    right.push_back(row[degree - level] << (degree - level));
  }
  return {left, {right.rbegin(), right.rend()}};
}

/// A vector that moves on a straight line: for each axis the Bernstein coefficients, which are its values at both ends
/// of the interval.
using Line = std::array<Bernstein, 3>;

struct MeetingQuestion {
  Bernstein coplanar;             ///< 0 at the times when the four points lie in one plane
  std::vector<Bernstein> inside;  ///< not negative at such a time if the primitives meet
  /// the vectors from each vertex of the second primitive to each vertex of the first; a direction whose products with
  /// all of them are positive separates the primitives
  std::vector<Line> apart;
  Line along;  ///< vector along the first of two edges
};

/// Returns whether the scalar products of `direction` with all vectors of `apart` have the same strict sign at all
/// times.
inline bool parted_by(const MeetingQuestion& q, const std::array<Integer, 3>& direction) {
  int positive = 0, negative = 0;
  for (const Line& line : q.apart)
    for (std::size_t end = 0; end < 2; ++end) {
      const Integer height = direction[0] * line[0][end] + direction[1] * line[1][end] + direction[2] * line[2][end];
      positive += height > 0, negative += height < 0;
    }
  const int all = static_cast<int>(2 * q.apart.size());
  return positive == all || negative == all;
}

/// Returns whether the direction perpendicular to the first edge, towards the second edge, separates the primitives.
/// Any direction that separates them is a proof, so a rounded direction suffices. For parallel edges no other direction
/// can separate.
inline bool parted_across_edge(const MeetingQuestion& q) {
  using reference::operator*, reference::operator-;
  reference::Triple<double> w, u;
  for (std::size_t k = 0; k < 3; ++k) {
    w[k] = Integer(q.apart[0][k][0] + q.apart[0][k][1]).convert_to<double>();
    u[k] = Integer(q.along[k][0] + q.along[k][1]).convert_to<double>();
  }
  for (int pass = 0; pass < 2; ++pass) w = w - (reference::dot(w, u) / reference::dot(u, u)) * u;
  const double size = std::sqrt(reference::dot(w, w));
  if (!(size > 0)) return false;
  return parted_by(q, {scaled(w[0] / size), scaled(w[1] / size), scaled(w[2] / size)});
}

inline bool excluded(const MeetingQuestion& q, int depth) {
  if (all_positive(q.coplanar) || all_negative(q.coplanar)) return true;
  for (const Bernstein& p : q.inside)
    if (all_negative(p)) return true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<Integer, 3> direction{0, 0, 0};
    direction[axis] = 1;
    if (parted_by(q, direction)) return true;
  }
  return depth % 8 == 0 && !q.along[0].empty() && parted_across_edge(q);
}

inline bool meets(const MeetingQuestion& q, int depth) {
  if (excluded(q, depth)) return false;
  if (depth == 0) return true;
  std::array<MeetingQuestion, 2> parts;
  const auto divide = [&](const Bernstein& p, auto place) {
    auto two = halves(p);
    for (std::size_t k = 0; k < 2; ++k) place(parts[k]) = std::move(two[k]);
  };
  for (MeetingQuestion& part : parts) part.inside.resize(q.inside.size()), part.apart.resize(q.apart.size());
  divide(q.coplanar, [](MeetingQuestion& part) -> Bernstein& { return part.coplanar; });
  for (std::size_t k = 0; k < q.inside.size(); ++k)
    divide(q.inside[k], [k](MeetingQuestion& part) -> Bernstein& { return part.inside[k]; });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 0; k < q.apart.size(); ++k)
      divide(q.apart[k][axis], [=](MeetingQuestion& part) -> Bernstein& { return part.apart[k][axis]; });
    if (!q.along[0].empty())
      divide(q.along[axis], [axis](MeetingQuestion& part) -> Bernstein& { return part.along[axis]; });
  }
  return meets(parts[0], depth - 1) || meets(parts[1], depth - 1);
}

/// Returns whether 0 | 1 2 3 (vertex and triangle) or 0 1 | 2 3 (edges) meet on the way from x to x + `until` · delta.
inline bool exactly_meet(bool edges, const Points4& x, const Points4& delta, double until = 1, int depth = 120) {
  std::array<Vector, 4> p;
  const Integer share = scaled(until), one = Integer(1) << exact_bits;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Integer start = scaled(x[k][axis]) * one;
      p[k][axis].c = {start, start + scaled(delta[k][axis]) * share};
    }
  MeetingQuestion q;
  const auto add = [&](const Scaled& s) { q.inside.push_back(bernstein(s)); };
  if (edges) {
    const Vector u = p[1] - p[0], v = p[3] - p[2], w = p[2] - p[0], n = crossed(u, v);
    q.coplanar = bernstein(dotted(w, n));
    const Scaled s = dotted(crossed(w, v), n), t = dotted(crossed(w, u), n), whole = dotted(n, n);
    for (const Scaled& c : {s, t, whole - s, whole - t}) add(c);
  } else {
    const Vector a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0], n = crossed(p[2] - p[1], p[3] - p[1]);
    q.coplanar = bernstein(dotted(a, n));
    add(dotted(crossed(b, c), n)), add(dotted(crossed(c, a), n)), add(dotted(crossed(a, b), n));
  }
  const auto line = [](const Vector& v) { return Line{v[0].c, v[1].c, v[2].c}; };
  for (std::size_t i = 0; i < (edges ? 2u : 1u); ++i)
    for (std::size_t j = edges ? 2 : 1; j < 4; ++j) q.apart.push_back(line(p[i] - p[j]));
  if (edges) q.along = line(p[1] - p[0]);
  return meets(q, depth);
}

}  // namespace ogc::tests
