// The energies of a hinge over any number type, one for each bending model, and the block of one vertex (method.md
// §4.7, §4.9).
#pragma once

#include <tuple>

#include "compare/problem/scene.hpp"
#include "reference/energies/closest_form.hpp"
#include "reference/energies/fold.hpp"
#include "reference/energies/vertex_block.hpp"

namespace ogc::reference {

/// A hinge. Its energy is c/2 ((θ − θ₀)² + k (θ − θᵗ)²), in the isometric model c/2 (‖Σ w x‖² + k (θ − θᵗ)²). Terms
/// with θ are 0 if a triangle has collapsed.
template <class Number>
struct HingeTermOf {
  std::array<compare::Index, 4> vertex{};
  Number stiffness = 0.0, rest_angle = 0.0, damping = 0.0;  ///< c [J], θ₀ [rad], k [1]
  Number start = 0.0;                                       ///< θᵗ [rad]
  std::array<Number, 4> weight{};                           ///< w [1/m]
  compare::BendingModel model = compare::BendingModel::discrete_hinge;

  /// Returns whether elastic energy or damping depends on the angle.
  bool has_angle() const {
    switch (model) {
      case compare::BendingModel::none: break;
      case compare::BendingModel::discrete_hinge: return true;
      case compare::BendingModel::isometric_quadratic: return damping == 0.0 ? false : true;
    }
    return false;
  }
  /// Returns the energy terms that depend on the angle: elastic energy and damping, but only damping in the isometric
  /// model.
  template <class T>
  T energy_of(const T& angle) const {
    const T moved = angle - T(start), elastic = elastic_of(angle);
    return damping == 0.0 ? elastic : elastic + 0.5 * stiffness * damping * moved * moved;
  }
  /// Returns the energy terms that depend on positions but not on the angle: c/2 ‖Σ w x‖² of the isometric model.
  template <class T>
  T energy_of(const Hinge<T>& x) const {
    T elastic(0.0);
    switch (model) {
      case compare::BendingModel::none:
      case compare::BendingModel::discrete_hinge: break;
      case compare::BendingModel::isometric_quadratic: {
        const Triple<T> curvature = separation(weight, x);
        elastic = 0.5 * stiffness * dot(curvature, curvature);
      }
    }
    return elastic;
  }
  /// Returns the energy without damping [J].
  template <class T>
  T elastic(const Hinge<T>& x) const {
    HingeTermOf undamped = *this;
    undamped.damping = 0.0;
    return undamped.energy(x);
  }
  /// Returns the energy, damping included [J].
  template <class T>
  T energy(const Hinge<T>& x) const {
    const T elastic = energy_of(x);
    if (!has_angle()) return elastic;
    const Fold<T> fold(x);
    return fold.collapsed() ? elastic : elastic + energy_of(fold.angle());
  }

  /// Returns the constants (head of stencil_terms.hpp).
  auto numbers() { return std::tie(stiffness, rest_angle, damping, start, weight); }
  auto numbers() const { return std::tie(stiffness, rest_angle, damping, start, weight); }
  /// Returns the properties that stencils evaluated together must share (head of stencil_terms.hpp).
  auto kinds() { return std::tie(model); }
  auto kinds() const { return std::tie(model); }

 private:
  template <class T>
  T elastic_of(const T& angle) const {
    T elastic(0.0);
    switch (model) {
      case compare::BendingModel::none:
      case compare::BendingModel::isometric_quadratic: break;
      case compare::BendingModel::discrete_hinge: {
        const T bent = angle - T(rest_angle);
        elastic = 0.5 * stiffness * bent * bent;
      }
    }
    return elastic;
  }
};
/// A hinge over doubles.
using HingeTerm = HingeTermOf<double>;

/// Adds force and block of the terms with θ. The block is c (1 + k) ∇θ ∇θᵀ, in the isometric model k c ∇θ ∇θᵀ.
template <class Number>
void add_angle(const HingeTermOf<Number>& term, const ByOwn<Number>& angle, VertexSystemOf<Number>& sum) {
  const Second<1, Number> energy = along(angle.value, [&](const Second<1, Number>& a) { return term.energy_of(a); });
  add_force(energy.slope[0], angle.slope, sum);
  add_outer(energy.bend(0), angle.slope, angle.slope, sum.block);
}

/// Adds the isometric model's force and its block c w² I.
template <class Number>
void add_positions(const HingeTermOf<Number>& term, const Hinge<ByOwn<Number>>& x, VertexSystemOf<Number>& sum) {
  switch (term.model) {
    case compare::BendingModel::none:
    case compare::BendingModel::discrete_hinge: return;
    case compare::BendingModel::isometric_quadratic:
      add_force(1.0, term.energy_of(x).slope, sum);
      for (const ByOwn<Number>& component : separation(term.weight, x))
        add_outer(term.stiffness, component.slope, component.slope, sum.block);
  }
}

}  // namespace ogc::reference
