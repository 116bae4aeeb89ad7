// Two number types that measure how sensitive a formula is to its inputs: forward-mode derivatives, and the sum of the
// moduli of all terms, which also bounds the rounding error of the value.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace ogc::reference {

/// A value with its derivatives by N inputs.
template <std::size_t N>
struct Dual {
  double value = 0;               ///< value of the expression
  std::array<double, N> slope{};  ///< by input

  Dual() = default;
  explicit Dual(double constant) : value(constant) {}
  Dual(double at, std::size_t input) : value(at) { slope[input] = 1; }

  friend Dual operator+(Dual a, const Dual& b) {
    a.value += b.value;
    for (std::size_t i = 0; i < N; ++i) a.slope[i] += b.slope[i];
    return a;
  }
  friend Dual operator-(Dual a, const Dual& b) {
    a.value -= b.value;
    for (std::size_t i = 0; i < N; ++i) a.slope[i] -= b.slope[i];
    return a;
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual c(a.value * b.value);
    for (std::size_t i = 0; i < N; ++i) c.slope[i] = a.slope[i] * b.value + a.value * b.slope[i];
    return c;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    Dual c(a.value / b.value);
    for (std::size_t i = 0; i < N; ++i) c.slope[i] = (a.slope[i] - c.value * b.slope[i]) / b.value;
    return c;
  }
};

/// A value in double precision, with its modulus: the value of the formula with every term replaced by its absolute
/// value. For a homogeneous polynomial m of degree k, Σ|∂m/∂δᵢ||δᵢ| ≤ k · modulus, because each monomial has k factors.
/// If at most n roundings lie between an input and the value, the value has an error of at most n 2⁻⁵³ · modulus, to
/// first order.
struct Measured {
  double value = 0, modulus = 0;

  Measured() = default;
  explicit Measured(double x) : value(x), modulus(std::abs(x)) {}
  Measured(double at, double terms) : value(at), modulus(terms) {}
  friend Measured operator+(Measured a, Measured b) { return {a.value + b.value, a.modulus + b.modulus}; }
  friend Measured operator-(Measured a, Measured b) { return {a.value - b.value, a.modulus + b.modulus}; }
  friend Measured operator*(Measured a, Measured b) { return {a.value * b.value, a.modulus * b.modulus}; }
};

}  // namespace ogc::reference
