// Forward differentiation to second order of a function of N variables: value, gradient and one triangle of the Hessian. Nesting Derivative in itself would
// carry the other triangle too; Newton's method differentiates each stencil of a mesh in each iteration, so this is worth a type of its own.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "reference/energies/derivative.hpp"

namespace ogc::reference {

/// Calls visit(i, j, k) for each entry k = (i, j), j ≤ i, of a triangle of N rows, written out: short loops of changing length cost more than their bodies.
template <std::size_t N, class Visit>
[[gnu::always_inline]] inline void for_triangle(Visit visit) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    const auto row = [&]<std::size_t Row, std::size_t... J>(std::integral_constant<std::size_t, Row>, std::index_sequence<J...>) [[gnu::always_inline]] {
      (visit(Row, J, Row * (Row + 1) / 2 + J), ...);
    };
    (row(std::integral_constant<std::size_t, I>{}, std::make_index_sequence<I + 1>{}), ...);
  }(std::make_index_sequence<N>{});
}

template <std::size_t N>
struct Second {
  double value = 0;
  std::array<double, N> slope{};
  std::array<double, N*(N + 1) / 2> bend{};  ///< row i holds ∂²/∂i∂j for j ≤ i
  bool linear = true;                        ///< bend is known to hold zeros, as of positions, edges and F: then it is not computed with

  Second() = default;
  Second(double constant) : value(constant) {}

  friend Second operator+(Second a, const Second& b) {
    a.value += b.value;
    for (std::size_t i = 0; i < N; ++i) a.slope[i] += b.slope[i];
    if (b.linear) return a;
    a.linear = false;
    for (std::size_t k = 0; k < a.bend.size(); ++k) a.bend[k] += b.bend[k];
    return a;
  }
  friend Second operator-(Second a, const Second& b) {
    a.value -= b.value;
    for (std::size_t i = 0; i < N; ++i) a.slope[i] -= b.slope[i];
    if (b.linear) return a;
    a.linear = false;
    for (std::size_t k = 0; k < a.bend.size(); ++k) a.bend[k] -= b.bend[k];
    return a;
  }
  friend Second operator-(const Second& a) { return -1.0 * a; }
  friend Second operator*(double factor, Second a) {
    a.value *= factor;
    for (double& x : a.slope) x *= factor;
    if (a.linear) return a;
    for (double& x : a.bend) x *= factor;
    return a;
  }
  friend Second operator*(const Second& a, const Second& b) {
    Second c(a.value * b.value);
    c.linear = false;
    for (std::size_t i = 0; i < N; ++i) c.slope[i] = a.slope[i] * b.value + a.value * b.slope[i];
    for_triangle<N>([&](std::size_t i, std::size_t j, std::size_t k) { c.bend[k] = a.slope[i] * b.slope[j] + a.slope[j] * b.slope[i]; });
    if (!a.linear)
      for (std::size_t k = 0; k < c.bend.size(); ++k) c.bend[k] += a.bend[k] * b.value;
    if (!b.linear)
      for (std::size_t k = 0; k < c.bend.size(); ++k) c.bend[k] += a.value * b.bend[k];
    return c;
  }
  friend Second operator/(const Second& a, const Second& b) {
    const double inverse = 1 / b.value;
    return a * composed(inverse, -inverse * inverse, 2 * inverse * inverse * inverse, b);
  }
  /// f(x) from f, f' and f'' there.
  friend Second composed(double f, double first, double second, const Second& x) {
    Second result(f);
    result.linear = false;
    for (std::size_t i = 0; i < N; ++i) result.slope[i] = first * x.slope[i];
    for_triangle<N>([&](std::size_t i, std::size_t j, std::size_t k) { result.bend[k] = second * x.slope[i] * x.slope[j]; });
    if (!x.linear)
      for (std::size_t k = 0; k < result.bend.size(); ++k) result.bend[k] += first * x.bend[k];
    return result;
  }
  /// At 0 all derivatives are taken as 0, as by Derivative.
  friend Second sqrt(const Second& x) {
    if (x.value == 0) return {};
    const double root = std::sqrt(x.value);
    return composed(root, 0.5 / root, -0.25 / (root * x.value), x);
  }
  friend Second log(const Second& x) { return composed(std::log(x.value), 1 / x.value, -1 / (x.value * x.value), x); }
  /// The imaginary part of log(x + iy), whose second derivative is that of z''/z − (z'/z)². Not both 0.
  friend Second atan2(const Second& y, const Second& x) {
    const double squared = x.value * x.value + y.value * y.value;
    Second angle(std::atan2(y.value, x.value));
    angle.linear = false;
    std::array<double, N> stretch;
    for (std::size_t i = 0, k = 0; i < N; ++i) {
      stretch[i] = (x.value * x.slope[i] + y.value * y.slope[i]) / squared;
      angle.slope[i] = (x.value * y.slope[i] - y.value * x.slope[i]) / squared;
      for (std::size_t j = 0; j <= i; ++j, ++k)
        angle.bend[k] = (x.value * y.bend[k] - y.value * x.bend[k]) / squared - (stretch[i] * angle.slope[j] + stretch[j] * angle.slope[i]);
    }
    return angle;
  }
};

template <std::size_t N>
double plain(const Second<N>& x) {
  return x.value;
}

template <std::size_t N>
Triple<Second<N>> operator*(double factor, const Triple<Second<N>>& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

}  // namespace ogc::reference
