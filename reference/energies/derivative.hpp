// Forward differentiation: a number that stores its value and its derivatives by N inputs. No derivative of an energy
// is written by hand here. The type can be nested. Two levels give second derivatives. If the innermost level
// differentiates by all given numbers of a test case, each derivative also shows how strongly it reacts to rounding of
// the given numbers (Inputs::condition).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "compare/problem/vector.hpp"

namespace ogc::reference {

/// Returns the value without derivatives.
inline double plain(double x) { return x; }

/// A number with its derivatives by N inputs. Slopes with indices from `count` on are 0 and are not computed, because
/// most factors of an energy depend on few inputs.
template <class T, std::size_t N>
struct Derivative {
  T value{};                 ///< value of the expression
  std::size_t count = 0;     ///< number of slopes that may differ from 0
  std::array<T, N> slope{};  ///< by input

  Derivative() = default;
  Derivative(const T& constant) : value(constant) {}
  Derivative(double constant) requires(!std::is_same_v<T, double>) : value(constant) {}
  /// Makes the input with index `direction` and the value `at`.
  Derivative(const T& at, std::size_t direction) : value(at), count(direction + 1) { slope[direction] = T(1.0); }

  friend Derivative operator+(Derivative a, const Derivative& b) {
    a.value = a.value + b.value;
    for (std::size_t i = 0; i < b.count; ++i) a.slope[i] = a.slope[i] + b.slope[i];
    a.count = std::max(a.count, b.count);
    return a;
  }
  friend Derivative operator-(Derivative a, const Derivative& b) {
    a.value = a.value - b.value;
    for (std::size_t i = 0; i < b.count; ++i) a.slope[i] = a.slope[i] - b.slope[i];
    a.count = std::max(a.count, b.count);
    return a;
  }
  friend Derivative operator*(const Derivative& a, const Derivative& b) {
    Derivative c(T(a.value * b.value));
    c.count = std::max(a.count, b.count);
    const std::size_t both = std::min(a.count, b.count);
    for (std::size_t i = 0; i < both; ++i) c.slope[i] = a.slope[i] * b.value + a.value * b.slope[i];
    for (std::size_t i = both; i < a.count; ++i) c.slope[i] = a.slope[i] * b.value;
    for (std::size_t i = both; i < b.count; ++i) c.slope[i] = a.value * b.slope[i];
    return c;
  }
  friend Derivative operator/(const Derivative& a, const Derivative& b) {
    Derivative c(T(a.value / b.value));
    c.count = std::max(a.count, b.count);
    for (std::size_t i = 0; i < b.count; ++i) c.slope[i] = (a.slope[i] - c.value * b.slope[i]) / b.value;
    for (std::size_t i = b.count; i < a.count; ++i) c.slope[i] = a.slope[i] / b.value;
    return c;
  }
  friend Derivative operator-(const Derivative& a) { return Derivative() - a; }
  Derivative& operator+=(const Derivative& b) { return *this = *this + b; }
  Derivative& operator-=(const Derivative& b) { return *this = *this - b; }
  Derivative& operator*=(const Derivative& b) { return *this = *this * b; }
  /// Compares values only, for branches.
  friend bool operator==(const Derivative& a, double b) requires(!std::is_same_v<T, double>) { return a.value == b; }
  friend bool operator==(const Derivative& a, const T& b) { return a.value == b; }
};

/// Returns −1 if x < 0, else 1.
inline double sign_of(double x) { return x < 0 ? -1.0 : 1.0; }
template <class T, std::size_t N>
double plain(const Derivative<T, N>& x) {
  return plain(x.value);
}

/// Returns max(0, x). Keeps the derivatives of x even if x < 0: the judge's error scales come from them, and rounding
/// may make x positive.
inline double positive_part(double x) { return std::max(0.0, x); }
template <class T, std::size_t N>
Derivative<T, N> positive_part(Derivative<T, N> x) {
  x.value = positive_part(x.value);
  return x;
}

/// Returns max(0, x) for a product x = `factor` · y. If x < 0, the result is 0, and its derivatives are `factor` times
/// the derivatives of y.
inline double positive_part(double x, double) { return std::max(0.0, x); }
template <class T, std::size_t N>
Derivative<T, N> positive_part(const Derivative<T, N>& x, const Derivative<T, N>& factor) {
  if (!(plain(x) < 0) || plain(factor) == 0) return x;
  return factor * positive_part(x / factor);
}

/// Returns f(x) from `value` = f(x) and `slope` = f'(x).
template <class T, std::size_t N>
Derivative<T, N> chained(const T& value, const T& slope, const Derivative<T, N>& x) {
  Derivative<T, N> result(value);
  result.count = x.count;
  for (std::size_t i = 0; i < x.count; ++i) result.slope[i] = slope * x.slope[i];
  return result;
}

/// Returns the root, with the derivative 0 at x = 0. Energies multiply the root by a quantity that is also 0 there.
template <class T, std::size_t N>
Derivative<T, N> sqrt(const Derivative<T, N>& x) {
  using std::sqrt;
  if (plain(x) == 0) return {};
  const T root = sqrt(x.value);
  return chained(root, T(T(0.5) / root), x);
}

template <class T, std::size_t N>
Derivative<T, N> log(const Derivative<T, N>& x) {
  using std::log;
  return chained(T(log(x.value)), T(T(1.0) / x.value), x);
}

/// Returns the angle of (x, y), which must not both be 0.
template <class T, std::size_t N>
Derivative<T, N> atan2(const Derivative<T, N>& y, const Derivative<T, N>& x) {
  using std::atan2;
  const T squared = x.value * x.value + y.value * y.value;
  Derivative<T, N> angle(T(atan2(y.value, x.value)));
  angle.count = std::max(x.count, y.count);
  for (std::size_t i = 0; i < angle.count; ++i)
    angle.slope[i] = (x.value * y.slope[i] - y.value * x.slope[i]) / squared;
  return angle;
}

/// Three coordinates of any number type.
template <class T>
using Triple = std::array<T, 3>;

/// Returns the length of a vector.
inline double length(const Triple<double>& a) { return std::hypot(a[0], a[1], a[2]); }

/// Returns a point in double precision.
inline Triple<double> widened(const compare::Vec3f& p) { return {p.x, p.y, p.z}; }

template <class T>
Triple<T> operator-(const Triple<T>& a, const Triple<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class T>
Triple<T> operator+(const Triple<T>& a, const Triple<T>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class T>
Triple<T> operator*(const T& s, const Triple<T>& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
template <class T, std::size_t N>
Triple<Derivative<T, N>> operator*(const std::type_identity_t<T>& s, const Triple<Derivative<T, N>>& a) {
  return Derivative<T, N>(s) * a;
}
/// Returns Σ aᵢ bᵢ.
template <class T>
T dot(const Triple<T>& a, const Triple<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/// Returns a × b.
template <class T>
Triple<T> cross(const Triple<T>& a, const Triple<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace ogc::reference
