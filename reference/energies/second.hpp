// Forward differentiation to second order of a function of N variables: value, gradient, and one triangle of the
// Hessian. `Derivative` nested in itself would also compute the other triangle. The separate type saves time, because
// Newton's method differentiates each stencil of a mesh in each iteration. `Number` is double, or several doubles in
// SIMD lanes (lanes.hpp).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "reference/energies/derivative.hpp"

namespace ogc::reference {

/// Calls visit(i, j, k) for each entry (i, j), j ≤ i, of a lower triangle of N rows; k is the entry's index. The loop
/// is unrolled, because short loops of varying length cost more than their bodies.
template <std::size_t N, class Visit>
[[gnu::always_inline]] inline void for_triangle(Visit visit) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    const auto row = [&]<std::size_t Row, std::size_t... J>(std::integral_constant<std::size_t, Row>,
                                                            std::index_sequence<J...>) [[gnu::always_inline]] {
      (visit(Row, J, Row * (Row + 1) / 2 + J), ...);
    };
    (row(std::integral_constant<std::size_t, I>{}, std::make_index_sequence<I + 1>{}), ...);
  }
  (std::make_index_sequence<N>{});
}

/// A number with gradient and Hessian. Linear numbers (positions, edges, F) do not store their second derivatives,
/// which are 0 and would be more than three quarters of the copied data.
template <std::size_t N, class Number = double>
class Second {
 public:
  /// number of second derivatives; each pair of inputs counts once
  static constexpr std::size_t bends = N * (N + 1) / 2;
  Number value;                 ///< value of the expression
  std::array<Number, N> slope;  ///< by input

  Second() : Second(Number(0.0)) {}
  Second(const Number& constant) : value(constant), slope{} {}
  Second(double constant) requires(!std::is_same_v<Number, double>) : Second(Number(constant)) {}
  Second(const Second& other) : value(other.value), slope(other.slope), linear_(other.linear_) {
    if (!linear_) bend_ = other.bend_;
  }
  Second& operator=(const Second& other) {
    value = other.value;
    slope = other.slope;
    linear_ = other.linear_;
    if (!linear_) bend_ = other.bend_;
    return *this;
  }

  /// Returns entry k of the Hessian's lower triangle, row by row: row i holds ∂²/∂i∂j for j ≤ i.
  Number bend(std::size_t k) const { return linear_ ? Number(0.0) : bend_[k]; }

  friend Second operator+(Second a, const Second& b) {
    a.value += b.value;
    for (std::size_t i = 0; i < N; ++i) a.slope[i] += b.slope[i];
    if (b.linear_) return a;
    if (a.linear_) {
      a.bend_ = b.bend_;
    } else {
      for (std::size_t k = 0; k < bends; ++k) a.bend_[k] += b.bend_[k];
    }
    a.linear_ = false;
    return a;
  }
  friend Second operator-(Second a, const Second& b) {
    a.value -= b.value;
    for (std::size_t i = 0; i < N; ++i) a.slope[i] -= b.slope[i];
    if (b.linear_) return a;
    if (a.linear_) {
      for (std::size_t k = 0; k < bends; ++k) a.bend_[k] = -b.bend_[k];
    } else {
      for (std::size_t k = 0; k < bends; ++k) a.bend_[k] -= b.bend_[k];
    }
    a.linear_ = false;
    return a;
  }
  friend Second operator-(const Second& a) { return -1.0 * a; }
  friend Second operator*(const Number& factor, Second a) {
    a.value *= factor;
    for (Number& x : a.slope) x *= factor;
    if (a.linear_) return a;
    for (Number& x : a.bend_) x *= factor;
    return a;
  }
  friend Second operator*(double factor, const Second& a) requires(!std::is_same_v<Number, double>) {
    return Number(factor) * a;
  }
  friend Second operator*(const Second& a, const Second& b) {
    Second c(Open{}, a.value * b.value);
    for (std::size_t i = 0; i < N; ++i) c.slope[i] = a.slope[i] * b.value + a.value * b.slope[i];
    for_triangle<N>([&](std::size_t i, std::size_t j, std::size_t k)
                        [[gnu::always_inline]] { c.bend_[k] = a.slope[i] * b.slope[j] + a.slope[j] * b.slope[i]; });
    if (!a.linear_ && !b.linear_) {
      for (std::size_t k = 0; k < bends; ++k) c.bend_[k] = c.bend_[k] + a.bend_[k] * b.value + a.value * b.bend_[k];
    } else if (!a.linear_) {
      for (std::size_t k = 0; k < bends; ++k) c.bend_[k] += a.bend_[k] * b.value;
    } else if (!b.linear_) {
      for (std::size_t k = 0; k < bends; ++k) c.bend_[k] += a.value * b.bend_[k];
    }
    return c;
  }
  friend Second operator/(const Second& a, const Second& b) {
    const Number inverse = 1.0 / b.value;
    return a * composed(inverse, -inverse * inverse, 2.0 * inverse * inverse * inverse, b);
  }
  /// Returns f(x). `f`, `first` and `second` are the values of f, f' and f'' at x.
  friend Second composed(const Number& f, const Number& first, const Number& second, const Second& x) {
    Second result(Open{}, f);
    for (std::size_t i = 0; i < N; ++i) result.slope[i] = first * x.slope[i];
    for_triangle<N>([&](std::size_t i, std::size_t j, std::size_t k)
                        [[gnu::always_inline]] { result.bend_[k] = second * x.slope[i] * x.slope[j]; });
    if (!x.linear_)
      for (std::size_t k = 0; k < bends; ++k) result.bend_[k] += first * x.bend_[k];
    return result;
  }
  /// Returns the root; at x = 0 all derivatives are 0, as for Derivative.
  friend Second sqrt(const Second& x) {
    using std::sqrt;
    if (x.value == 0.0) return {};
    const Number root = sqrt(x.value);
    return composed(root, 0.5 / root, -0.25 / (root * x.value), x);
  }
  friend Second log(const Second& x) {
    using std::log;
    return composed(log(x.value), 1.0 / x.value, -1.0 / (x.value * x.value), x);
  }
  /// Returns the imaginary part of log z, z = x + iy ≠ 0. Its second derivative is the imaginary part of z''/z −
  /// (z'/z)².
  friend Second atan2(const Second& y, const Second& x) {
    using std::atan2;
    const Number squared = x.value * x.value + y.value * y.value;
    Second angle(Open{}, Number(atan2(y.value, x.value)));
    std::array<Number, N> stretch;
    for (std::size_t i = 0, k = 0; i < N; ++i) {
      stretch[i] = (x.value * x.slope[i] + y.value * y.slope[i]) / squared;
      angle.slope[i] = (x.value * y.slope[i] - y.value * x.slope[i]) / squared;
      for (std::size_t j = 0; j <= i; ++j, ++k)
        angle.bend_[k] = (x.value * y.bend(k) - y.value * x.bend(k)) / squared -
                         (stretch[i] * angle.slope[j] + stretch[j] * angle.slope[i]);
    }
    return angle;
  }

 private:
  /// Selects the constructor that leaves slopes and second derivatives uninitialised; the caller must fill them at
  /// once.
  struct Open {};
  Second(Open, const Number& at) : value(at), linear_(false) {}

  std::array<Number, bends> bend_;
  bool linear_ = true;  ///< whether all second derivatives are 0; bend_ is then not read
};

template <std::size_t N, class Number>
Number plain(const Second<N, Number>& x) {
  return x.value;
}

template <std::size_t N, class Number>
Triple<Second<N, Number>> operator*(const std::type_identity_t<Number>& factor, const Triple<Second<N, Number>>& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

}  // namespace ogc::reference
