// The energy of each kind of stencil as one scalar function of its vertices, over any number type (method.md §4).
// Newton's method differentiates the energy by all vertices. The stages of the sweep differentiate by one vertex, with
// the same strains and angles. `Number` is the type of a stencil's constants: a double, or SIMD lanes with one double
// for each of several stencils that are evaluated together. `numbers` returns these constants. `kinds` returns the
// properties that select branches; all stencils evaluated together must share them.
#pragma once

#include <tuple>

#include "compare/problem/scene.hpp"
#include "compare/problem/vector.hpp"
#include "reference/energies/closest_form.hpp"
#include "reference/energies/contact_activation.hpp"

namespace ogc::reference {

/// A contact with the energy e_k g(d). The features that hold the contact points are found when the energy is
/// evaluated.
template <class Number>
struct ContactTermOf {
  compare::ContactSides sides = compare::ContactSides::point_point;
  std::array<compare::Index, 4> vertex{-1, -1, -1, -1};
  Number contact_radius = 0.0, stiffness = 0.0;  ///< r [m]; k_c [N/m]
  Number mollifier = 1.0;                        ///< e_k of the last detection
  Number friction = 0.0;                         ///< μ [1]
  compare::ContactActivation activation = compare::ContactActivation::ogc;

  /// Returns the energy at a distance of the contact points [J].
  template <class T>
  T energy_at(const T& distance) const {
    return mollifier * contact_activation(activation, distance, contact_radius, stiffness);
  }
  /// Returns the energy at the vertices x [J]; `form` holds the closest features (closest_form.hpp).
  template <class T, std::size_t N>
  T energy(const ClosestForm& form, const std::array<Triple<T>, N>& x) const {
    return energy_at(form_distance(form, x));
  }

  /// Returns the constants (head of this file).
  auto numbers() { return std::tie(contact_radius, stiffness, mollifier); }
  auto numbers() const { return std::tie(contact_radius, stiffness, mollifier); }
  /// Returns the properties that stencils evaluated together must share (head of this file).
  auto kinds() { return std::tie(activation); }
  auto kinds() const { return std::tie(activation); }
};
/// A contact over doubles.
using ContactTerm = ContactTermOf<double>;

/// Lagged friction of a contact: μ λ f₀(‖u‖), u = (I − n nᵀ)(Σ wᵢ xᵢ − Σ wᵢ xᵢᵗ). λ, n and w are constants, taken from
/// a fixed state.
template <class Number>
struct FrictionTermOf {
  compare::ContactSides sides = compare::ContactSides::point_point;
  std::array<compare::Index, 4> vertex{-1, -1, -1, -1};
  std::array<Number, 4> weight{};
  Triple<Number> normal{}, start{};  ///< n; Σ wᵢ xᵢᵗ [m]
  Number force = 0.0, limit = 0.0;   ///< μ λ [N]; ε = ε_v h [m]

  /// Returns the slip u at the positions x of the vertices.
  template <class T, std::size_t N>
  Triple<T> slip(const std::array<Triple<T>, N>& x) const {
    return slip_between(separation(weight, x));
  }
  /// Returns the slip u; the argument `moved` is Σ wᵢ xᵢ.
  template <class T>
  Triple<T> slip_between(Triple<T> moved) const {
    for (std::size_t k = 0; k < 3; ++k) moved[k] = moved[k] - T(start[k]);
    const T along = normal[0] * moved[0] + normal[1] * moved[1] + normal[2] * moved[2];
    return moved - Triple<T>{normal[0] * along, normal[1] * along, normal[2] * along};
  }
  /// Returns the energy μ λ f₀(y) for `squared` = y² = ‖u‖². f₀(y) is y − ε/3 for y ≥ ε and y²/ε − y³/(3ε²) below. So
  /// f₀(0) = 0 and f₀' = f₁.
  template <class T>
  T energy_of(const T& squared) const {
    using std::sqrt;
    const T length = sqrt(squared);
    if (plain(length) >= limit) return force * (length - T(limit / 3.0));
    return force / limit * (squared - 1.0 / (3.0 * limit) * squared * length);
  }
  /// Returns the energy at the vertices [J].
  template <class T, std::size_t N>
  T energy(const std::array<Triple<T>, N>& x) const {
    return energy_between(separation(weight, x));
  }
  /// Returns the energy [J]; `apart` is Σ wᵢ xᵢ.
  template <class T>
  T energy_between(const Triple<T>& apart) const {
    const Triple<T> u = slip_between(apart);
    return energy_of(dot(u, u));
  }

  auto numbers() { return std::tie(weight, normal, start, force, limit); }
  auto numbers() const { return std::tie(weight, normal, start, force, limit); }
  auto kinds() { return std::tie(); }
  auto kinds() const { return std::tie(); }
};
/// Friction over doubles.
using FrictionTerm = FrictionTermOf<double>;

}  // namespace ogc::reference
