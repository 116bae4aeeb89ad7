// Defines quaternions, in single precision with the layout of compare::Quaternion. Sums of products are evaluated from
// the left, as in vector.hpp.
#pragma once

#include "fast/kernels/arithmetic/scalar.hpp"
#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// The quaternion x i + y j + z k + w. Its alignment lets a device read four floats at once.
template <class T>
struct alignas(4 * sizeof(T)) QuatOf {
  T x = 0, y = 0, z = 0, w = 1;  ///< factors of i, j, k, and the real part
};
using Quat = QuatOf<float>;

template <class T>
OGC_HD QuatOf<T> operator+(const QuatOf<T>& a, const QuatOf<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
}
template <class T>
OGC_HD QuatOf<T> operator-(const QuatOf<T>& a, const QuatOf<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w};
}
template <class T>
OGC_HD QuatOf<T> operator*(T s, const QuatOf<T>& a) {
  return {s * a.x, s * a.y, s * a.z, s * a.w};
}
/// Returns a if the condition holds, else b; the condition selects each component separately.
template <class T, class M>
OGC_HD QuatOf<T> select(const M& condition, const QuatOf<T>& a, const QuatOf<T>& b) {
  return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z),
          select(condition, a.w, b.w)};
}
template <class T>
OGC_HD QuatOf<T> operator*(const QuatOf<T>& a, const QuatOf<T>& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z,
          a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
template <class T>
OGC_HD QuatOf<T> conjugate(const QuatOf<T>& a) {
  return {-a.x, -a.y, -a.z, a.w};
}
template <class T>
OGC_HD T dot(const QuatOf<T>& a, const QuatOf<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}
template <class T>
OGC_HD QuatOf<T> pure(const Vector<T>& v) {
  return {v.x, v.y, v.z, T(0.0f)};
}

/// Returns R(q) v = v + 2 w (u × v) + 2 u × (u × v), where u is the vector part of q and w its real part.
OGC_HD inline Vec turned(const Quat& q, const Vec& v) {
  const Vec u{q.x, q.y, q.z}, twice = 2.0f * cross(u, v);
  return v + q.w * twice + cross(u, twice);
}
/// Returns R(q)ᵀ v.
OGC_HD inline Vec turned_back(const Quat& q, const Vec& v) { return turned(conjugate(q), v); }

/// Returns R(q) e₃, the direction of a segment of this orientation.
OGC_HD inline Vec director(const Quat& q) { return turned(q, {0.0f, 0.0f, 1.0f}); }

/// Returns q/‖q‖ for q ≠ 0, with a norm within 4 · 2⁻²⁴ of 1. The second factor, a Newton step, corrects the root and
/// the quotient, which a device may round inexactly.
template <class T>
OGC_HD QuatOf<T> unit(const QuatOf<T>& q) {
  const QuatOf<T> near = T(1.0f / root(dot(q, q))) * q;
  return T(1.5f - 0.5f * dot(near, near)) * near;
}

}  // namespace ogc::fast
