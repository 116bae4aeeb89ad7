// Defines vectors over any number type: float for the sweep, the types of exact_sign.hpp for detection. `Vec` has the
// layout of compare::Vec3f, so that arrays of positions are copied without conversion.
#pragma once

#include "fast/kernels/arithmetic/qualifiers.hpp"

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

/// A point or vector in single precision; its unit is given at each use.
using Vec = Vector<float>;

/// A position padded to 16 bytes, which a device loads with one instruction and a CPU holds in one register.
struct alignas(16) PaddedVec {
  float x = 0, y = 0, z = 0, unused = 0;  ///< `unused` pads to 16 B

  PaddedVec() = default;
  OGC_HD explicit PaddedVec(const Vec& a) : x(a.x), y(a.y), z(a.z) {}
  OGC_HD operator Vec() const { return {x, y, z}; }
};

/// An array of padded positions; each access loads all 16 bytes at once.
struct PaddedVecs {
  const PaddedVec* at = nullptr;  ///< by vertex [m]

  OGC_HD Vec operator[](int v) const {
    const PaddedVec whole = at[v];
    return whole;
  }
};

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
/// Returns a·b. Products are added from the left, because the order of rounded sums changes bits.
template <class T>
OGC_HD T dot(const Vector<T>& a, const Vector<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
OGC_HD Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace ogc::fast
