// The energies of a triangle over any number type (method.md §4.6, §4.9).
#pragma once

#include "reference/energies/derivative.hpp"

namespace ogc::reference {

/// The columns of F, 3×2.
template <class T>
using Deformation = std::array<Triple<T>, 2>;

/// G by its components xx, xy, yy.
template <class T>
using Strain = std::array<T, 3>;

/// ϕ(G) = λ/2 tr(G)² + μ ‖G‖² [J/m²]. The constants, here and below, may be plain numbers.
template <class T, class Lame>
T density(const Strain<T>& g, const Lame& lambda, const Lame& mu) {
  const T trace = g[0] + g[2];
  return Lame(0.5) * lambda * trace * trace + mu * (g[0] * g[0] + Lame(2.0) * g[1] * g[1] + g[2] * g[2]);
}

/// F of the map from the rest plane that takes the corners to x.
template <class T, class Gradient>
Deformation<T> deformation(const std::array<Triple<T>, 3>& x, const std::array<std::array<Gradient, 2>, 3>& gradient) {
  Deformation<T> f;
  for (std::size_t axis = 0; axis < 2; ++axis)
    f[axis] = gradient[0][axis] * x[0] + gradient[1][axis] * x[1] + gradient[2][axis] * x[2];
  return f;
}

/// G = (FᵀF − I)/2.
template <class T>
Strain<T> strain(const Deformation<T>& f) {
  return {0.5 * (dot(f[0], f[0]) - T(1.0)), 0.5 * dot(f[0], f[1]), 0.5 * (dot(f[1], f[1]) - T(1.0))};
}

/// μ/2 (‖F‖² − 2) − μ (J − 1) + (λ + μ)/2 (J − 1)², J = ‖f₁ × f₂‖ [J/m²]. Near rest the first two terms cancel, and
/// their rounding would be more than all of the energy of a cloth in free fall; ‖F‖² − 2 J = (‖F‖⁴ − 4 J²)/(‖F‖² + 2
/// J), whose numerator is a sum of squares, loses nothing.
template <class T, class Lame>
T neo_hookean_density(const Deformation<T>& f, const Lame& lambda, const Lame& mu) {
  using std::sqrt;
  const Triple<T> normal = cross(f[0], f[1]);
  const T squared[] = {dot(f[0], f[0]), dot(f[1], f[1])}, both = dot(f[0], f[1]);
  const T size = sqrt(dot(normal, normal)), grown = size - T(1.0), size_of_f = squared[0] + squared[1];
  const T bulk = Lame(0.5) * (lambda + mu) * grown * grown;
  // collapsed: J has no derivatives
  if (plain(size) == 0.0) return Lame(0.5) * mu * (size_of_f - T(2.0)) - mu * grown + bulk;
  const T unequal = squared[0] - squared[1];
  return Lame(0.5) * mu * ((unequal * unequal + T(4.0) * both * both) / (size_of_f + T(2.0) * size)) + bulk;
}

}  // namespace ogc::reference
