// The energy of each kind of stencil as one scalar function of its vertices, over any number type (method.md §4).
// Newton's method differentiates these; the stages of the sweep ask for one vertex at a time and share strain and angle
// with them. `Number`: of what a stencil knows, a double, or one for each of several stencils side by side; `numbers`
// are those, `kinds` is what all of them must have in common.
#pragma once

#include <tuple>

#include "compare/problem/scene.hpp"
#include "compare/problem/vector.hpp"
#include "reference/energies/closest_form.hpp"
#include "reference/energies/contact_activation.hpp"
#include "reference/energies/fold.hpp"
#include "reference/energies/spring.hpp"
#include "reference/energies/strain.hpp"

namespace ogc::reference {

/// A triangle: A (ψ + k ϕ(G − Gᵗ)) (compare/stages/membrane.hpp).
template <class Number>
struct MembraneTermOf {
  std::array<compare::Index, 3> vertex{};
  std::array<std::array<Number, 2>, 3> gradient{};           ///< ∇N [1/m]
  Number area = 0.0, lambda = 0.0, mu = 0.0, damping = 0.0;  ///< A [m²], Lamé [N/m], k = k_d/h [1]
  Strain<Number> start{};                                    ///< Gᵗ
  compare::MembraneModel model = compare::MembraneModel::st_venant_kirchhoff;

  /// Parts of the energy by what they depend on: elastic_of a strain or, in the stable Neo-Hookean model, of F; damping
  /// of a strain.
  template <class T>
  T elastic_of(const Strain<T>& g) const {
    return area * density(g, lambda, mu);
  }
  template <class T>
  T elastic_of(const Deformation<T>& f) const {
    return area * neo_hookean_density(f, lambda, mu);
  }
  template <class T>
  T damping_of(const Strain<T>& g) const {
    const Strain<T> change{g[0] - T(start[0]), g[1] - T(start[1]), g[2] - T(start[2])};
    return area * damping * density(change, lambda, mu);
  }
  bool neo_hookean() const { return model == compare::MembraneModel::stable_neo_hookean; }
  template <class T>
  T elastic(const std::array<Triple<T>, 3>& x) const {
    const Deformation<T> f = deformation<T>(x, gradient);
    return neo_hookean() ? elastic_of(f) : elastic_of(strain(f));
  }
  template <class T>
  T energy(const std::array<Triple<T>, 3>& x) const {
    const Deformation<T> f = deformation<T>(x, gradient);
    const Strain<T> g = strain(f);
    const T psi = neo_hookean() ? elastic_of(f) : elastic_of(g);
    return damping == 0.0 ? psi : psi + damping_of(g);
  }

  auto numbers() { return std::tie(gradient, area, lambda, mu, damping, start); }
  auto numbers() const { return std::tie(gradient, area, lambda, mu, damping, start); }
  auto kinds() { return std::tie(model); }
  auto kinds() const { return std::tie(model); }
};
using MembraneTerm = MembraneTermOf<double>;

/// A hinge: c/2 ((θ − θ₀)² + k (θ − θᵗ)²), in the isometric model c/2 (‖Σ w x‖² + k (θ − θᵗ)²); what holds θ is 0 where
/// a triangle has collapsed.
template <class Number>
struct HingeTermOf {
  std::array<compare::Index, 4> vertex{};
  Number stiffness = 0.0, rest_angle = 0.0, damping = 0.0;  ///< c [J], θ₀ [rad], k [1]
  Number start = 0.0;                                       ///< θᵗ [rad]
  bool isometric = false;
  std::array<Number, 4> weight{};  ///< w [1/m]

  /// What depends on the angle: all of it, or the isometric model's damping.
  template <class T>
  T energy_of(const T& angle) const {
    const T bent = angle - T(rest_angle), moved = angle - T(start);
    const T elastic = isometric ? T(0.0) : 0.5 * stiffness * bent * bent;
    return damping == 0.0 ? elastic : elastic + 0.5 * stiffness * damping * moved * moved;
  }
  /// The isometric model's c/2 ‖Σ w x‖².
  template <class T>
  T isometric_energy(const Hinge<T>& x) const {
    const Triple<T> curvature = separation(weight, x);
    return 0.5 * stiffness * dot(curvature, curvature);
  }
  template <class T>
  T elastic(const Hinge<T>& x) const {
    if (isometric) return isometric_energy(x);
    const Fold<T> fold(x);
    if (fold.collapsed()) return T(0.0);
    const T bent = fold.angle() - T(rest_angle);
    return 0.5 * stiffness * bent * bent;
  }
  template <class T>
  T energy(const Hinge<T>& x) const {
    const T elastic = isometric ? isometric_energy(x) : T(0.0);
    if (isometric && damping == 0.0) return elastic;
    const Fold<T> fold(x);
    return fold.collapsed() ? elastic : elastic + energy_of(fold.angle());
  }

  auto numbers() { return std::tie(stiffness, rest_angle, damping, start, weight); }
  auto numbers() const { return std::tie(stiffness, rest_angle, damping, start, weight); }
  auto kinds() { return std::tie(isometric); }
  auto kinds() const { return std::tie(isometric); }
};
using HingeTerm = HingeTermOf<double>;

/// A spring: k_s/2 ((l − l₀)² + k (l − lᵗ)²), l = ‖Σ wᵢ xᵢ‖: of an end and a point between two others, or another
/// vertex.
template <class Number>
struct SpringTermOf {
  std::array<compare::Index, 4> vertex{-1, -1, -1, -1};
  std::array<Number, 4> weight{1.0, -1.0, 0.0, 0.0};
  Number stiffness = 0.0, rest_length = 0.0, damping = 0.0;  ///< k_s [N/m], l₀ [m], k [1]
  Number start = 0.0;                                        ///< lᵗ [m]

  template <class T>
  T elastic(const std::array<Triple<T>, 4>& x) const {
    return about(separation(weight, x), rest_length);
  }
  /// Of Σ wᵢ xᵢ.
  template <class T>
  T energy_between(const Triple<T>& apart) const {
    return damping == 0.0 ? about(apart, rest_length) : about(apart, rest_length) + damping * about(apart, start);
  }
  template <class T>
  T energy(const std::array<Triple<T>, 4>& x) const {
    return energy_between(separation(weight, x));
  }

  auto numbers() { return std::tie(weight, stiffness, rest_length, damping, start); }
  auto numbers() const { return std::tie(weight, stiffness, rest_length, damping, start); }
  auto kinds() { return std::tie(); }
  auto kinds() const { return std::tie(); }

 private:
  /// At length 0 from a length the direction is open: there the root has no derivatives.
  template <class T>
  T about(const Triple<T>& apart, const Number& from) const {
    using std::sqrt;
    const T squared = dot(apart, apart);
    return from == 0.0 ? 0.5 * stiffness * squared : spring_energy(T(sqrt(squared)), stiffness, T(from));
  }
};
using SpringTerm = SpringTermOf<double>;

/// A contact: e_k g(d). The form is found where the energy is asked for.
template <class Number>
struct ContactTermOf {
  compare::ContactSides sides = compare::ContactSides::point_point;
  std::array<compare::Index, 4> vertex{-1, -1, -1, -1};
  Number radius = 0.0, stiffness = 0.0;  ///< r [m]; k_c [N/m]
  Number mollifier = 1.0;                ///< e_k of the last detection
  Number friction = 0.0;                 ///< μ [1]
  compare::ContactActivation activation = compare::ContactActivation::ogc;

  template <class T>
  T energy_at(const T& distance) const {
    return mollifier * contact_activation(activation, distance, radius, stiffness);
  }
  template <class T, std::size_t N>
  T energy(const ClosestForm& form, const std::array<Triple<T>, N>& x) const {
    return energy_at(form_distance(form, x));
  }

  auto numbers() { return std::tie(radius, stiffness, mollifier); }
  auto numbers() const { return std::tie(radius, stiffness, mollifier); }
  auto kinds() { return std::tie(activation); }
  auto kinds() const { return std::tie(activation); }
};
using ContactTerm = ContactTermOf<double>;

/// Lagged friction of a contact: μ λ f₀(‖u‖), u = (I − n nᵀ)(Σ wᵢ xᵢ − Σ wᵢ xᵢᵗ), with λ, n and w of a fixed state.
template <class Number>
struct FrictionTermOf {
  compare::ContactSides sides = compare::ContactSides::point_point;
  std::array<compare::Index, 4> vertex{-1, -1, -1, -1};
  std::array<Number, 4> weight{};
  Triple<Number> normal{}, start{};  ///< n; Σ wᵢ xᵢᵗ [m]
  Number force = 0.0, limit = 0.0;   ///< μ λ [N]; ε = ε_v h [m]

  /// u over any number type, of the corners or of Σ wᵢ xᵢ.
  template <class T, std::size_t N>
  Triple<T> slip(const std::array<Triple<T>, N>& x) const {
    return slip_between(separation(weight, x));
  }
  template <class T>
  Triple<T> slip_between(Triple<T> moved) const {
    for (std::size_t k = 0; k < 3; ++k) moved[k] = moved[k] - T(start[k]);
    const T along = normal[0] * moved[0] + normal[1] * moved[1] + normal[2] * moved[2];
    return moved - Triple<T>{normal[0] * along, normal[1] * along, normal[2] * along};
  }
  /// By ‖u‖². f₀' = f₁: y − ε/3 beyond ε, y²/ε − y³/(3ε²) below, 0 at rest.
  template <class T>
  T energy_of(const T& squared) const {
    using std::sqrt;
    const T length = sqrt(squared);
    if (plain(length) >= limit) return force * (length - T(limit / 3.0));
    return force / limit * (squared - 1.0 / (3.0 * limit) * squared * length);
  }
  template <class T, std::size_t N>
  T energy(const std::array<Triple<T>, N>& x) const {
    return energy_between(separation(weight, x));
  }
  /// By Σ wᵢ xᵢ.
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
using FrictionTerm = FrictionTermOf<double>;

}  // namespace ogc::reference
