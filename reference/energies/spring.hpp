// Defines the energy of a spring over any number type and the block of one of its vertices (method.md §4.8, §4.9).
// Declares the stage spring.
#pragma once

#include <tuple>

#include "compare/stages/spring.hpp"
#include "reference/energies/closest_form.hpp"
#include "reference/energies/vertex_block.hpp"

namespace ogc::reference {

/// Returns k_s/2 (l − l₀)².
template <class T, class Number>
T spring_energy(const T& length, const Number& stiffness, const T& rest_length) {
  return Number(0.5) * stiffness * (length - rest_length) * (length - rest_length);
}

/// A spring between two vertices, or between a vertex and a point on the line of two others. Its energy is k_s/2 ((l −
/// l₀)² + k (l − lᵗ)²) with l = ‖Σ wᵢ xᵢ‖.
template <class Number>
struct SpringTermOf {
  std::array<compare::Index, 4> vertex{-1, -1, -1, -1};
  std::array<Number, 4> weight{1.0, -1.0, 0.0, 0.0};
  Number stiffness = 0.0, rest_length = 0.0, damping = 0.0;  ///< k_s [N/m], l₀ [m], k [1]
  Number start = 0.0;                                        ///< lᵗ [m]

  /// Returns the energy without damping [J].
  template <class T>
  T elastic(const std::array<Triple<T>, 4>& x) const {
    return about(separation(weight, x), rest_length);
  }
  /// Returns the energy, damping included [J]; `apart` is Σ wᵢ xᵢ.
  template <class T>
  T energy_between(const Triple<T>& apart) const {
    return damping == 0.0 ? about(apart, rest_length) : about(apart, rest_length) + damping * about(apart, start);
  }
  /// Returns the energy, damping included [J].
  template <class T>
  T energy(const std::array<Triple<T>, 4>& x) const {
    return energy_between(separation(weight, x));
  }

  /// Returns the constants (head of stencil_terms.hpp).
  auto numbers() { return std::tie(weight, stiffness, rest_length, damping, start); }
  auto numbers() const { return std::tie(weight, stiffness, rest_length, damping, start); }
  /// Returns the properties that stencils evaluated together must share (head of stencil_terms.hpp).
  auto kinds() { return std::tie(); }
  auto kinds() const { return std::tie(); }

 private:
  /// Returns k_s/2 (l − from)². If l = 0 and from > 0, the spring has no direction, and all derivatives are 0.
  template <class T>
  T about(const Triple<T>& apart, const Number& from) const {
    using std::sqrt;
    const T squared = dot(apart, apart);
    return from == 0.0 ? 0.5 * stiffness * squared : spring_energy(T(sqrt(squared)), stiffness, T(from));
  }
};
/// A spring over doubles.
using SpringTerm = SpringTermOf<double>;

/// Returns a spring's stiffness perpendicular to its direction, divided by k_s: max(0, 1 − l₀/l), or 1 if l = 0.
template <class Number>
Number held_across(const Number& length, const Number& rest_length) {
  return plain(length) == 0.0 ? Number(1.0) : positive_part(1.0 - rest_length / length);
}

/// Adds the force and the block w² k_s (n nᵀ + max(0, 1 − l₀/l)(I − n nᵀ)) + w² k k_s n nᵀ. The last term is damping.
/// If l = 0, the block is w² k_s I (compare/stages/spring.hpp). `apart` is Σ wᵢ xᵢ; `own_weight` is w, the weight of
/// the vertex.
template <class Number>
void add_spring(const SpringTermOf<Number>& term, const Number& own_weight, const Triple<ByOwn<Number>>& apart,
                VertexSystemOf<Number>& sum) {
  const ByOwn<Number> length = sqrt(dot(apart, apart));
  const Number squared_weight = own_weight * own_weight;
  if (plain(length) == 0.0) return add_identity(squared_weight * term.stiffness, sum.block);
  const Number across = held_across(length.value, term.rest_length);
  add_force(1.0, term.energy_between(apart).slope, sum);
  add_identity(squared_weight * term.stiffness * across, sum.block);
  add_outer(term.stiffness * (1.0 - across + term.damping), length.slope, length.slope, sum.block);
}

/// Computes one case; see compare/stages/spring.hpp.
compare::ForceAnswer spring(const compare::SpringCase& question);

/// Computes all cases, in parallel over them.
compare::ForceTruth spring(const compare::SpringIn& in);

}  // namespace ogc::reference
