// Vectors over any number type: float for the sweep, the types of exact_sign.hpp for detection. `Vec` has the layout of compare::Vec3f, so positions
// are copied, never converted.
#pragma once

#include "fast/kernels/qualifiers.hpp"

namespace ogc::fast {

template <class T>
struct Vector {
  T x{}, y{}, z{};

  OGC_HD Vector& operator+=(const Vector& b) {
    x = x + b.x, y = y + b.y, z = z + b.z;
    return *this;
  }
  OGC_HD Vector& operator-=(const Vector& b) {
    x = x - b.x, y = y - b.y, z = z - b.z;
    return *this;
  }
};

/// A point or vector in single precision [unit given where it is used].
using Vec = Vector<float>;

template <class T>
OGC_HD Vector<T> operator+(const Vector<T>& a, const Vector<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
OGC_HD Vector<T> operator-(const Vector<T>& a, const Vector<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
OGC_HD Vector<T> operator-(const Vector<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class T>
OGC_HD Vector<T> operator*(const T& s, const Vector<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
OGC_HD Vector<T> operator*(const Vector<T>& a, const T& s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class T>
OGC_HD T dot(const Vector<T>& a, const Vector<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
OGC_HD Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace ogc::fast
