// The energies of a triangle over any number type, one for each membrane model, and the block of one corner (method.md
// §4.6, §4.9).
#pragma once

#include <tuple>

#include "compare/problem/scene.hpp"
#include "reference/energies/vertex_block.hpp"

namespace ogc::reference {

/// The columns of F, 3×2.
template <class T>
using Deformation = std::array<Triple<T>, 2>;

/// Components xx, xy, yy of the symmetric Green strain G.
template <class T>
using Strain = std::array<T, 3>;

/// Returns ϕ(G) = λ/2 tr(G)² + μ ‖G‖² [J/m²]. Constants may be plain numbers.
template <class T, class Lame>
T density(const Strain<T>& g, const Lame& lambda, const Lame& mu) {
  const T trace = g[0] + g[2];
  return Lame(0.5) * lambda * trace * trace + mu * (g[0] * g[0] + Lame(2.0) * g[1] * g[1] + g[2] * g[2]);
}

/// Returns F, the gradient of the map from the rest plane to the corners x.
template <class T, class Gradient>
Deformation<T> deformation(const std::array<Triple<T>, 3>& x, const std::array<std::array<Gradient, 2>, 3>& gradient) {
  Deformation<T> f;
  for (std::size_t axis = 0; axis < 2; ++axis)
    f[axis] = gradient[0][axis] * x[0] + gradient[1][axis] * x[1] + gradient[2][axis] * x[2];
  return f;
}

/// Returns G = (FᵀF − I)/2.
template <class T>
Strain<T> strain(const Deformation<T>& f) {
  return {0.5 * (dot(f[0], f[0]) - T(1.0)), 0.5 * dot(f[0], f[1]), 0.5 * (dot(f[1], f[1]) - T(1.0))};
}

/// Returns μ/2 (‖F‖² − 2) − μ (J − 1) + (λ + μ)/2 (J − 1)², J = ‖f₁ × f₂‖ [J/m²]. Near rest the first two terms cancel,
/// and their rounding would exceed the whole energy of a freely falling cloth. So they are computed as μ/2 (‖F‖² − 2 J)
/// with ‖F‖² − 2 J = (‖F‖⁴ − 4 J²)/(‖F‖² + 2 J), whose numerator is a sum of squares.
template <class T, class Lame>
T neo_hookean_density(const Deformation<T>& f, const Lame& lambda, const Lame& mu) {
  using std::sqrt;
  const Triple<T> normal = cross(f[0], f[1]);
  const T squared[] = {dot(f[0], f[0]), dot(f[1], f[1])}, both = dot(f[0], f[1]);
  const T size = sqrt(dot(normal, normal)), grown = size - T(1.0), size_of_f = squared[0] + squared[1];
  const T bulk = Lame(0.5) * (lambda + mu) * grown * grown;
  // The triangle has collapsed: J has no derivatives.
  if (plain(size) == 0.0) return Lame(0.5) * mu * (size_of_f - T(2.0)) - mu * grown + bulk;
  const T unequal = squared[0] - squared[1];
  return Lame(0.5) * mu * ((unequal * unequal + T(4.0) * both * both) / (size_of_f + T(2.0) * size)) + bulk;
}

/// A triangle with the energy A (ψ + k ϕ(G − Gᵗ)) (compare/stages/membrane.hpp).
template <class Number>
struct MembraneTermOf {
  std::array<compare::Index, 3> vertex{};
  std::array<std::array<Number, 2>, 3> gradient{};           ///< ∇N [1/m]
  Number area = 0.0, lambda = 0.0, mu = 0.0, damping = 0.0;  ///< A [m²], Lamé [N/m], k = k_d/h [1]
  Strain<Number> start{};                                    ///< Gᵗ
  compare::MembraneModel model = compare::MembraneModel::st_venant_kirchhoff;

  /// Returns A ϕ(G).
  template <class T>
  T elastic_of(const Strain<T>& g) const {
    return area * density(g, lambda, mu);
  }
  /// Returns A ψ(F) of the stable Neo-Hookean model.
  template <class T>
  T elastic_of(const Deformation<T>& f) const {
    return area * neo_hookean_density(f, lambda, mu);
  }
  /// Returns A k ϕ(G − Gᵗ) [J].
  template <class T>
  T damping_of(const Strain<T>& g) const {
    const Strain<T> change{g[0] - T(start[0]), g[1] - T(start[1]), g[2] - T(start[2])};
    return area * damping * density(change, lambda, mu);
  }
  /// Returns the energy without damping [J].
  template <class T>
  T elastic(const std::array<Triple<T>, 3>& x) const {
    const Deformation<T> f = deformation<T>(x, gradient);
    return elastic_of(f, strain(f));
  }
  /// Returns the energy, damping included [J].
  template <class T>
  T energy(const std::array<Triple<T>, 3>& x) const {
    const Deformation<T> f = deformation<T>(x, gradient);
    const Strain<T> g = strain(f);
    const T psi = elastic_of(f, g);
    return damping == 0.0 ? psi : psi + damping_of(g);
  }

  /// Returns the constants (head of stencil_terms.hpp).
  auto numbers() { return std::tie(gradient, area, lambda, mu, damping, start); }
  auto numbers() const { return std::tie(gradient, area, lambda, mu, damping, start); }
  /// Returns what must be equal in stencils that are evaluated together (head of stencil_terms.hpp).
  auto kinds() { return std::tie(model); }
  auto kinds() const { return std::tie(model); }

 private:
  template <class T>
  T elastic_of(const Deformation<T>& f, const Strain<T>& g) const {
    T psi(0.0);
    switch (model) {
      case compare::MembraneModel::none: break;
      case compare::MembraneModel::st_venant_kirchhoff: psi = elastic_of(g); break;
      case compare::MembraneModel::stable_neo_hookean: psi = elastic_of(f); break;
    }
    return psi;
  }
};
/// A triangle over doubles.
using MembraneTerm = MembraneTermOf<double>;

/// Holds F and G as functions of one corner's position. `by_strain` is a copy of G whose components are the variables.
template <class Number>
struct MembraneCorner {
  Deformation<ByOwnTwice<Number>> f;
  Strain<ByOwnTwice<Number>> g, by_strain;

  /// Takes the corners [m]; the corner at `place` is the variable.
  MembraneCorner(const MembraneTermOf<Number>& term, std::size_t place, const std::array<Triple<Number>, 3>& corners)
      : f(deformation<ByOwnTwice<Number>>(with_own<ByOwnTwice<Number>>(corners, place), term.gradient)), g(strain(f)) {
    for (std::size_t i = 0; i < 3; ++i) by_strain[i] = variable(g[i].value, i);
  }
};

/// Adds force and block of an energy E of the strain G. The block is the material part (∂G/∂x)ᵀ (∂²E/∂G²) ∂G/∂x.
template <class Number>
void add_strain(const Strain<ByOwnTwice<Number>>& g, const ByOwnTwice<Number>& energy, VertexSystemOf<Number>& sum) {
  for (std::size_t i = 0, k = 0; i < 3; ++i) {
    add_force(energy.slope[i], g[i].slope, sum);
    for (std::size_t j = 0; j <= i; ++j, ++k)
      add_outer((i == j ? 1.0 : 2.0) * energy.bend(k), g[i].slope, g[j].slope, sum.block);
  }
}

/// Adds the geometric part of the block, max(0, s) I, where s I is Σ ∂E/∂Gᵢ ∂²Gᵢ/∂x² for the elastic energy E and the
/// corner x. Each ∂²Gᵢ/∂x² is a multiple of I.
template <class Number>
void add_geometric(const Number& area, const Strain<ByOwnTwice<Number>>& g, const ByOwnTwice<Number>& elastic,
                   VertexSystemOf<Number>& sum) {
  Number geometric = 0.0;
  for (std::size_t i = 0; i < 3; ++i) geometric += elastic.slope[i] * g[i].bend(0);
  add_identity(positive_part(geometric, area), sum.block);
}

/// Adds the exact force, and the exact second derivative as the block. If the block's eigenvalue along the normal is
/// negative, replaces this eigenvalue by 0.
template <class Number>
void add_neo_hookean(const Number& area, const ByOwnTwice<Number>& energy, const Triple<Number>& normal,
                     VertexSystemOf<Number>& sum) {
  add_exactly(energy, sum);
  Triple<Number> along_normal{};
  for (std::size_t i = 0, k = 0; i < 3; ++i)
    for (std::size_t j = 0; j <= i; ++j, ++k) {
      along_normal[i] += energy.bend(k) * normal[j];
      if (i != j) along_normal[j] += energy.bend(k) * normal[i];
    }
  const Number squared = dot(normal, normal);
  if (!(plain(squared) > 0)) return;
  const Number eigenvalue = dot(normal, along_normal) / squared;
  add_outer((positive_part(eigenvalue, area) - eigenvalue) / squared, normal, normal, sum.block);
}

/// Adds force and block of a corner without damping.
template <class Number>
void add_elastic(const MembraneTermOf<Number>& term, const MembraneCorner<Number>& at, VertexSystemOf<Number>& sum) {
  switch (term.model) {
    case compare::MembraneModel::none: return;
    case compare::MembraneModel::st_venant_kirchhoff: {
      const ByOwnTwice<Number> elastic = term.elastic_of(at.by_strain);
      add_strain(at.g, elastic, sum);
      return add_geometric(term.area, at.g, elastic, sum);
    }
    case compare::MembraneModel::stable_neo_hookean: {
      Deformation<Number> f;
      for (std::size_t axis = 0; axis < 2; ++axis)
        for (std::size_t i = 0; i < 3; ++i) f[axis][i] = at.f[axis][i].value;
      return add_neo_hookean(term.area, term.elastic_of(at.f), cross(f[0], f[1]), sum);
    }
  }
}

/// Adds force and block of the damping energy A k ϕ(G − Gᵗ).
template <class Number>
void add_damping(const MembraneTermOf<Number>& term, const MembraneCorner<Number>& at, VertexSystemOf<Number>& sum) {
  if (plain(term.damping) > 0) add_strain(at.g, term.damping_of(at.by_strain), sum);
}

}  // namespace ogc::reference
