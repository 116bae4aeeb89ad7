// Holds every polynomial of the contact geometry, once, for any number type. Intervals and exact numbers decide its
// sign; dual numbers give its sensitivity. Roots and divisions are removed by multiplication with positive lengths.
#pragma once

#include <array>

namespace ogc::reference {

/// A point or vector over the number type T.
template <class T>
struct Point {
  T x{}, y{}, z{};  ///< coordinates
};

template <class T>
Point<T> operator-(const Point<T>& a, const Point<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// Returns Σ aᵢ bᵢ.
template <class T>
T dot(const Point<T>& a, const Point<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Returns a × b.
template <class T>
Point<T> cross(const Point<T>& a, const Point<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Returns (p−a)·(b−a). It is > 0 if p is on b's side of the plane that contains the point a and is perpendicular to ab
/// (Eq. 8, 9, 14, 15).
template <class T>
T along(const Point<T>& a, const Point<T>& b, const Point<T>& p) {
  return dot(p - a, b - a);
}

/// Returns ((b−a)×(p−a))·((b−a)×(c−a)) (Eq. 9 times −‖e‖², Eq. 10). It is > 0 if p is on c's side of the plane that
/// contains ab and is perpendicular to the triangle abc.
template <class T>
T side(const Point<T>& a, const Point<T>& b, const Point<T>& c, const Point<T>& p) {
  const Point<T> e = b - a;
  return dot(cross(e, p - a), cross(e, c - a));
}

/// Returns ((q₀−p)×(q₁−q₀))·((x−p)×(q₁−q₀)): > 0 if a step from p towards x comes nearer to the line q₀q₁. The result
/// equals ‖q₁−q₀‖² (c−p)·(x−p), where c is the foot of p on the line: the plane test of Eq. 15 for c.
template <class T>
T turn(const Point<T>& p, const Point<T>& x, const Point<T>& q0, const Point<T>& q1) {
  const Point<T> v = q1 - q0;
  return dot(cross(q0 - p, v), cross(x - p, v));
}

/// Returns 10⁶ ‖e×e'‖² − ‖e‖² ‖e'‖²: < 0 if the edges are nearly parallel (method.md §1.4).
template <class T>
T parallel(const Point<T>& p0, const Point<T>& p1, const Point<T>& q0, const Point<T>& q1) {
  const Point<T> u = p1 - p0, v = q1 - q0;
  const Point<T> c = cross(u, v);
  return T(1e6) * dot(c, c) - dot(u, u) * dot(v, v);
}

/// A squared distance as a fraction; the denominator is positive.
template <class T>
struct Quotient {
  T numerator{}, denominator{};
};

/// Returns the squared distance between two points [m²].
template <class T>
Quotient<T> squared_distance_points(const Point<T>& a, const Point<T>& p) {
  return {dot(p - a, p - a), T(1)};
}

/// Returns the squared distance between p and the line through a and b [m²].
template <class T>
Quotient<T> squared_distance_line(const Point<T>& a, const Point<T>& b, const Point<T>& p) {
  const Point<T> e = b - a;
  const Point<T> c = cross(e, p - a);
  return {dot(c, c), dot(e, e)};
}

/// Returns the squared distance between p and the plane through a, b and c [m²].
template <class T>
Quotient<T> squared_distance_plane(const Point<T>& a, const Point<T>& b, const Point<T>& c, const Point<T>& p) {
  const Point<T> n = cross(b - a, c - a);
  const T height = dot(n, p - a);
  return {height * height, dot(n, n)};
}

/// Returns the squared distance between two lines [m²].
template <class T>
Quotient<T> squared_distance_lines(const Point<T>& p0, const Point<T>& p1, const Point<T>& q0, const Point<T>& q1) {
  const Point<T> n = cross(p1 - p0, q1 - q0);
  const T height = dot(n, q0 - p0);
  return {height * height, dot(n, n)};
}

}  // namespace ogc::reference
