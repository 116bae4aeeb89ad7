// Quaternions and the energy of a segment over any number type (compare/rods.md).
#pragma once

#include <array>

#include "reference/energies/derivative.hpp"

namespace ogc::reference {

/// A quaternion: the factors of i, j, k, then the real part.
template <class T>
using FourOf = std::array<T, 4>;

/// Returns the quaternion a · b.
template <class T>
FourOf<T> product(const FourOf<T>& a, const FourOf<T>& b) {
  const Triple<T> u{a[0], a[1], a[2]}, v{b[0], b[1], b[2]}, across = cross(u, v);
  FourOf<T> c;
  for (std::size_t k = 0; k < 3; ++k) c[k] = a[3] * v[k] + b[3] * u[k] + across[k];
  c[3] = a[3] * b[3] - dot(u, v);
  return c;
}

template <class T>
FourOf<T> conjugate(const FourOf<T>& a) {
  return {T(0.0) - a[0], T(0.0) - a[1], T(0.0) - a[2], a[3]};
}

template <class T>
FourOf<T> pure(const Triple<T>& v) {
  return {v[0], v[1], v[2], T(0.0)};
}

template <class T>
T inner(const FourOf<T>& a, const FourOf<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/// Returns R(q) v by the polynomials of compare/stages/rod.hpp. Other polynomials give the same vector only for unit
/// quaternions.
template <class T>
Triple<T> rotated(const FourOf<T>& q, const Triple<T>& v) {
  const Triple<T> u{q[0], q[1], q[2]}, once = cross(u, v), twice = once + once;
  return v + q[3] * twice + cross(u, twice);
}

/// Returns e₃ = (0, 0, 1), the direction of a segment in its own frame.
template <class T>
Triple<T> own_axis() {
  return {T(0.0), T(0.0), T(1.0)};
}

/// Returns k_s l/2 ‖`change`‖². `change` is a change of strain: D/l − R(q) e₃ relative to the rest shape, or R(q)ᵀ D/l
/// − R(qᵗ)ᵀ Dᵗ/l relative to the start of the step.
template <class T, class Number>
T stretch_energy(const Triple<T>& change, const Number& stretch, const Number& length) {
  return (Number(0.5) * stretch * length) * dot(change, change);
}

}  // namespace ogc::reference
