// The energies of a tetrahedron over any number type, and the block of one of its corners (method.md §4.9, §8). The
// stage tetrahedron differentiates them automatically.
#pragma once

#include <tuple>

#include "compare/problem/vector.hpp"
#include "compare/stages/tetrahedron.hpp"
#include "reference/energies/vertex_block.hpp"

namespace ogc::reference {

struct RestBuilder;

/// The columns of F, 3×3.
template <class T>
using SolidDeformation = std::array<Triple<T>, 3>;

/// G by its components xx, xy, xz, yy, yz, zz.
template <class T>
using SolidStrain = std::array<T, 6>;

/// Returns F, the gradient of the map from the corners at rest to x.
template <class T, class Gradient>
SolidDeformation<T> solid_deformation(const std::array<Triple<T>, 4>& x,
                                      const std::array<std::array<Gradient, 3>, 4>& gradient) {
  SolidDeformation<T> f;
  for (std::size_t axis = 0; axis < 3; ++axis)
    f[axis] = gradient[0][axis] * x[0] + gradient[1][axis] * x[1] + gradient[2][axis] * x[2] + gradient[3][axis] * x[3];
  return f;
}

/// Returns G = (FᵀF − I)/2.
template <class T>
SolidStrain<T> solid_strain(const SolidDeformation<T>& f) {
  const T one(1.0);
  return {0.5 * (dot(f[0], f[0]) - one), 0.5 * dot(f[0], f[1]), 0.5 * dot(f[0], f[2]),
          0.5 * (dot(f[1], f[1]) - one), 0.5 * dot(f[1], f[2]), 0.5 * (dot(f[2], f[2]) - one)};
}

/// Returns ϕ(G) = λ/2 tr(G)² + μ ‖G‖² [J/m³]. Constants may be plain numbers.
template <class T, class Lame>
T solid_quadratic(const SolidStrain<T>& g, const Lame& lambda, const Lame& mu) {
  const T trace = g[0] + g[3] + g[5];
  return Lame(0.5) * lambda * trace * trace +
         mu * (g[0] * g[0] + g[3] * g[3] + g[5] * g[5] + Lame(2.0) * (g[1] * g[1] + g[2] * g[2] + g[4] * g[4]));
}

/// Returns μ/2 (‖F‖² − 3) − μ (J − 1) + (λ + μ)/2 (J − 1)² [J/m³]. Near rest the first two terms cancel, and their
/// rounding would exceed the whole energy of a solid in free fall. With J² = det(I + 2G) they equal μ (tr(G) (J − 1) −
/// 4 I₂ − 8 det G)/(J + 1), where I₂ is the sum of the principal minors of G. Each term of this is of second order. If
/// J is not positive, nothing cancels.
template <class T, class Lame>
T solid_density(const SolidDeformation<T>& f, const Lame& lambda, const Lame& mu) {
  const T ratio = dot(f[0], cross(f[1], f[2])), grown = ratio - T(1.0);
  const T bulk = Lame(0.5) * (lambda + mu) * grown * grown;
  if (!(plain(ratio) > 0.0))
    return Lame(0.5) * mu * (dot(f[0], f[0]) + dot(f[1], f[1]) + dot(f[2], f[2]) - T(3.0)) - mu * grown + bulk;
  const SolidStrain<T> g = solid_strain(f);
  const T trace = g[0] + g[3] + g[5];
  const T minors = g[0] * g[3] - g[1] * g[1] + (g[0] * g[5] - g[2] * g[2]) + (g[3] * g[5] - g[4] * g[4]);
  const T determinant = g[0] * (g[3] * g[5] - g[4] * g[4]) - g[1] * (g[1] * g[5] - g[4] * g[2]) +
                        g[2] * (g[1] * g[4] - g[3] * g[2]);
  const T once = (T(4.0) * minors + T(8.0) * determinant + T(2.0) * trace) / (ratio + T(1.0));  // J − 1 without loss
  return mu * ((trace * once - T(4.0) * minors - T(8.0) * determinant) / (ratio + T(1.0))) + bulk;
}

/// A tetrahedron with the energy V (ψ + k ϕ(G − Gᵗ)). Here F is computed from the gradients ∇N. The stage
/// (compare/stages/tetrahedron.hpp) computes ψ from weights, whose roundings differ.
template <class Number>
struct TetrahedronTermOf {
  std::array<compare::Index, 4> vertex{};
  std::array<std::array<Number, 3>, 4> gradient{};             ///< ∇N [1/m]
  Number volume = 0.0, lambda = 0.0, mu = 0.0, damping = 0.0;  ///< V [m³], Lamé [Pa], k = k_d/h [1]
  SolidStrain<Number> start{};                                 ///< Gᵗ

  /// Returns V ψ(F) [J].
  template <class T>
  T elastic_of(const SolidDeformation<T>& f) const {
    return volume * solid_density(f, lambda, mu);
  }
  /// Returns V k ϕ(G − Gᵗ) [J].
  template <class T>
  T damping_of(const SolidStrain<T>& g) const {
    SolidStrain<T> change;
    for (std::size_t i = 0; i < change.size(); ++i) change[i] = g[i] - T(start[i]);
    return volume * damping * solid_quadratic(change, lambda, mu);
  }
  /// Returns the energy without damping [J].
  template <class T>
  T elastic(const std::array<Triple<T>, 4>& x) const {
    return elastic_of(solid_deformation<T>(x, gradient));
  }
  /// Returns the energy, damping included [J].
  template <class T>
  T energy(const std::array<Triple<T>, 4>& x) const {
    const SolidDeformation<T> f = solid_deformation<T>(x, gradient);
    return damping == 0.0 ? elastic_of(f) : elastic_of(f) + damping_of(solid_strain(f));
  }

  /// Returns the constants (head of stencil_terms.hpp).
  auto numbers() { return std::tie(gradient, volume, lambda, mu, damping, start); }
  auto numbers() const { return std::tie(gradient, volume, lambda, mu, damping, start); }
  /// Returns the properties that stencils evaluated together must share (head of stencil_terms.hpp).
  auto kinds() { return std::tie(); }
  auto kinds() const { return std::tie(); }
};
/// A tetrahedron over doubles.
using TetrahedronTerm = TetrahedronTermOf<double>;

/// Holds F and G as functions of one corner's position. `by_strain` is a copy of G whose components are the variables.
template <class Number>
struct TetrahedronCorner {
  SolidDeformation<ByOwnTwice<Number>> f;
  SolidStrain<ByOwnTwice<Number>> g;
  SolidStrain<Second<6, Number>> by_strain;

  /// Takes the corners [m]; the corner at `place` is the variable.
  TetrahedronCorner(const TetrahedronTermOf<Number>& term, std::size_t place,
                    const std::array<Triple<Number>, 4>& corners)
      : f(solid_deformation<ByOwnTwice<Number>>(with_own<ByOwnTwice<Number>>(corners, place), term.gradient)),
        g(solid_strain(f)) {
    for (std::size_t i = 0; i < 6; ++i) {
      by_strain[i] = Second<6, Number>(g[i].value);
      by_strain[i].slope[i] = Number(1.0);
    }
  }
};

/// Adds the force of E = V k ϕ(G − Gᵗ) and the material part of its block, (∂G/∂x)ᵀ (∂²E/∂G²) ∂G/∂x.
template <class Number>
void add_damping(const TetrahedronTermOf<Number>& term, const TetrahedronCorner<Number>& at,
                 VertexSystemOf<Number>& sum) {
  if (!(plain(term.damping) > 0)) return;
  const Second<6, Number> energy = term.damping_of(at.by_strain);
  for (std::size_t i = 0, k = 0; i < 6; ++i) {
    add_force(energy.slope[i], at.g[i].slope, sum);
    for (std::size_t j = 0; j <= i; ++j, ++k)
      add_outer((i == j ? 1.0 : 2.0) * energy.bend(k), at.g[i].slope, at.g[j].slope, sum.block);
  }
}

/// Returns the exact answer.
compare::ForceAnswer tetrahedron(const compare::TetrahedronCase& question);

/// Computes all cases, in parallel over them.
compare::ForceTruth tetrahedron(const compare::TetrahedronIn& in);

/// Adds the rest data of tetrahedra (solvers/kinds/rest_state.cpp).
void add_tetrahedra_at_rest(RestBuilder& to);

}  // namespace ogc::reference
