// Computes force and sweep block of one vertex, over any number type. Whole runs use doubles
// (solvers/vertex_system.hpp). The judged stages use Input numbers, which also give the error scales. Each energy's
// block is derived once, beside the energy (membrane_terms.hpp, hinge_terms.hpp, spring.hpp). This file has the common
// functions.
#pragma once

#include "reference/energies/derivative.hpp"
#include "reference/energies/second.hpp"

namespace ogc::reference {

/// Symmetric 3×3: xx, xy, xz, yy, yz, zz.
template <class Number>
using BlockOf = std::array<Number, 6>;

/// The force on a vertex and the sweep's approximation of its Hessian (method.md §4).
template <class Number>
struct VertexSystemOf {
  Triple<Number> force{};   ///< [N]
  BlockOf<Number> block{};  ///< [N/m]
};

/// Numbers with derivatives, to first and to second order, by the coordinates of the own vertex, on which the force
/// acts.
template <class Number>
using ByOwn = Derivative<Number, 3>;
template <class Number>
using ByOwnTwice = Second<3, Number>;

/// Returns coordinate `direction` of the own vertex as a variable.
template <class Number>
ByOwnTwice<Number> variable(const Number& value, std::size_t direction) {
  ByOwnTwice<Number> x(value);
  x.slope[direction] = Number(1.0);
  return x;
}

/// Sets `to` to three variables with the values x, the own vertex's coordinates.
template <class Number>
void set_own(Triple<ByOwn<Number>>& to, const Triple<Number>& x) {
  for (std::size_t axis = 0; axis < 3; ++axis) to[axis] = ByOwn<Number>(x[axis], axis);
}
template <class Number>
void set_own(Triple<ByOwnTwice<Number>>& to, const Triple<Number>& x) {
  for (std::size_t axis = 0; axis < 3; ++axis) to[axis] = variable(x[axis], axis);
}

/// Returns the corners of a stencil over T; the corner at `place` is the variable.
template <class T, class Number, std::size_t Count>
std::array<Triple<T>, Count> with_own(const std::array<Triple<Number>, Count>& corners, std::size_t place) {
  std::array<Triple<T>, Count> x;
  for (std::size_t k = 0; k < Count; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) x[k][axis] = T(corners[k][axis]);
  set_own(x[place], corners[place]);
  return x;
}

/// Returns `energy` at the angle or length `measure`, with its slope and curvature there.
template <class Number, class Energy>
Second<1, Number> along(const Number& measure, Energy energy) {
  Second<1, Number> x(measure);
  x.slope[0] = Number(1.0);
  return energy(x);
}

/// Subtracts slope · gradient from the force.
template <class Number>
void add_force(const std::type_identity_t<Number>& slope, const Triple<Number>& gradient, VertexSystemOf<Number>& sum) {
  for (std::size_t i = 0; i < 3; ++i) sum.force[i] -= slope * gradient[i];
}

/// Adds weight · a bᵀ, made symmetric, to the block.
template <class Number>
void add_outer(const std::type_identity_t<Number>& weight, const Triple<Number>& a, const Triple<Number>& b,
               BlockOf<Number>& block) {
  for (std::size_t i = 0, k = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j, ++k) block[k] += 0.5 * weight * (a[i] * b[j] + a[j] * b[i]);
}

/// Adds weight · I to the block.
template <class Number>
void add_identity(const std::type_identity_t<Number>& weight, BlockOf<Number>& block) {
  for (const std::size_t k : {0u, 3u, 5u}) block[k] += weight;
}

/// Subtracts the slope of an energy from the force, and adds its exact second derivative to the block.
template <class Number>
void add_exactly(const ByOwnTwice<Number>& energy, VertexSystemOf<Number>& sum) {
  add_force(1.0, energy.slope, sum);
  for (std::size_t i = 0, k = 0; i < 3; ++i)
    for (std::size_t j = 0; j <= i; ++j, ++k) {
      Triple<Number> a{}, b{};
      a[i] = b[j] = Number(1.0);
      add_outer((i == j ? 1.0 : 2.0) * energy.bend(k), a, b, sum.block);
    }
}

}  // namespace ogc::reference
