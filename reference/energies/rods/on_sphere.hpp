// Minimises the energy −½ qᵀ M q − b·q over the unit sphere of ℝ⁴, for any number type. Newton's method on the sphere
// finds a minimiser from a given q. It uses neither the eigenvectors of M nor the equation of the Lagrange multiplier.
#pragma once

#include <cmath>
#include <optional>

#include "reference/energies/rods/rod_terms.hpp"

namespace ogc::reference::on_sphere {

/// A 128-bit number with a mantissa of 113 bits; its exponents never overflow here.
__extension__ using Many = __float128;

inline double root(double x) { return std::sqrt(x); }
/// Computes the root in double precision, then takes two steps of Newton's method. Each step doubles the correct bits.
inline Many root(const Many& x) {
  if (!(x > 0)) return 0;
  Many r = std::sqrt(static_cast<double>(x));
  for (int step = 0; step < 2; ++step) r = (r + x / r) / 2;
  return r;
}

template <class T>
using Four = FourOf<T>;
/// A symmetric 3×3 matrix on the tangent space.
template <class T>
using Square = std::array<Triple<T>, 3>;

template <class T>
Four<T> scaled(const T& s, const Four<T>& a) {
  return {s * a[0], s * a[1], s * a[2], s * a[3]};
}
template <class T>
Four<T> sum(const Four<T>& a, const Four<T>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
}
template <class T>
T size_of(const Four<T>& a) {
  return root(inner(a, a));
}
template <class T>
T length_of(const Triple<T>& a) {
  return root(dot(a, a));
}

/// Returns the k-th of the quaternions i, j, k, 1.
template <class T>
Four<T> basis(std::size_t k) {
  Four<T> e{T(0.0), T(0.0), T(0.0), T(0.0)};
  e[k] = T(1.0);
  return e;
}

template <class T>
struct Problem {
  Triple<T> apart, direction;  ///< D [m], c = e₃ + k R(qᵗ)ᵀ Dᵗ/l [1] (compare/rods.md)
  T stretch;                   ///< k_s [N]
  Four<T> vector;              ///< b [N m]
  std::array<Four<T>, 4> matrix;

  void fill_matrix() {
    for (std::size_t k = 0; k < 4; ++k) {
      const Four<T> column = turned(basis<T>(k));
      for (std::size_t row = 0; row < 4; ++row) matrix[row][k] = column[row];
    }
  }
  /// Returns M q.
  Four<T> turned(const Four<T>& q) const {
    return scaled(T(T(-2.0) * stretch), product(product(pure(apart), q), pure(direction)));
  }
  Four<T> pull(const Four<T>& q) const {
    Four<T> all = vector;
    for (std::size_t row = 0; row < 4; ++row) all[row] += inner(matrix[row], q);
    return all;
  }
  T energy(const Four<T>& q) const {
    T all = T(0.0) - inner(vector, q);
    for (std::size_t row = 0; row < 4; ++row) all -= T(0.5) * q[row] * inner(matrix[row], q);
    return all;
  }
  template <class To>
  Problem<To> as() const {
    Problem<To> to;
    for (std::size_t k = 0; k < 3; ++k) {
      to.apart[k] = static_cast<To>(apart[k]);
      to.direction[k] = static_cast<To>(direction[k]);
    }
    to.stretch = static_cast<To>(stretch);
    for (std::size_t row = 0; row < 4; ++row) {
      to.vector[row] = static_cast<To>(vector[row]);
      for (std::size_t k = 0; k < 4; ++k) to.matrix[row][k] = static_cast<To>(matrix[row][k]);
    }
    return to;
  }
};

/// Returns a basis of the tangent space at q: q i, q j, q k.
template <class T>
std::array<Four<T>, 3> tangents(const Four<T>& q) {
  return {product(q, basis<T>(0)), product(q, basis<T>(1)), product(q, basis<T>(2))};
}

/// The slope of the energy along the tangents, and its second derivative on the sphere.
template <class T>
struct OnSphere {
  Triple<T> slope;
  Square<T> bend;

  OnSphere(const Problem<T>& problem, const Four<T>& q) {
    const Four<T> pull = problem.pull(q);
    const T multiplier = inner(q, pull);
    const auto along = tangents(q);
    for (std::size_t i = 0; i < 3; ++i) {
      slope[i] = T(0.0) - inner(pull, along[i]);
      Four<T> turned;
      for (std::size_t row = 0; row < 4; ++row) turned[row] = inner(problem.matrix[row], along[i]);
      for (std::size_t j = 0; j < 3; ++j) bend[i][j] = (i == j ? multiplier : T(0.0)) - inner(turned, along[j]);
    }
  }
};

/// Returns the solution x of (A + shift I) x = y by Cholesky's method; empty if A + shift I is not positive definite.
template <class T>
std::optional<Triple<T>> solve(const Square<T>& a, const T& shift, const Triple<T>& y) {
  std::array<Triple<T>, 3> lower;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      T left = a[i][j] + (i == j ? shift : T(0.0));
      for (std::size_t k = 0; k < j; ++k) left -= lower[i][k] * lower[j][k];
      if (i == j && !(left > 0.0)) return std::nullopt;
      lower[i][j] = i == j ? T(root(left)) : T(left / lower[j][j]);
    }
  Triple<T> x = y;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < i; ++k) x[i] -= lower[i][k] * x[k];
    x[i] /= lower[i][i];
  }
  for (std::size_t i = 3; i-- > 0;) {
    for (std::size_t k = i + 1; k < 3; ++k) x[i] -= lower[k][i] * x[k];
    x[i] /= lower[i][i];
  }
  return x;
}

/// Returns the minimiser that Newton's method finds from q. It stops if the slope is below `enough` · `unit` or the
/// energy stops falling. If the second derivative is not positive definite, a multiple of the identity is added.
template <class T>
Four<T> minimised(const Problem<T>& problem, Four<T> q, const T& unit, double enough) {
  q = scaled(T(T(1.0) / size_of(q)), q);
  T energy = problem.energy(q);
  for (int step = 0; step < 100; ++step) {
    const OnSphere<T> at(problem, q);
    if (!(length_of(at.slope) > T(enough) * unit)) break;
    T shift(0.0);
    auto turn = solve(at.bend, shift, at.slope);
    while (!turn) {
      // The shift begins very small, because curvatures have very different sizes.
      shift = shift > 0.0 ? T(T(16.0) * shift) : T(T(0x1p-120) * unit);
      turn = solve(at.bend, shift, at.slope);
    }
    bool lower = false;
    for (T share(1.0); share > T(0x1p-40) && !lower; share *= T(0.5)) {
      Four<T> there = product(
          q, Four<T>{T(0.0) - share * (*turn)[0], T(0.0) - share * (*turn)[1], T(0.0) - share * (*turn)[2], T(1.0)});
      there = scaled(T(T(1.0) / size_of(there)), there);
      const T found = problem.energy(there);
      // Near the minimum, rounding hides whether a step lowers the energy. A full step is correct there, so it is
      // accepted.
      const bool is_small = length_of(*turn) < T(1e-4) && shift == 0.0;
      if (found < energy || (is_small && share == 1.0)) q = there, energy = found, lower = true;
    }
    if (!lower) break;
  }
  return q;
}

}  // namespace ogc::reference::on_sphere
