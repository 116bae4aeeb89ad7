// The St. Venant–Kirchhoff energy of a triangle over any number type (scenes.md).
#pragma once

#include "reference/energies/derivative.hpp"

namespace ogc::reference {

/// G by its components xx, xy, yy.
template <class T>
using Strain = std::array<T, 3>;

/// ψ(G) = λ/2 tr(G)² + μ ‖G‖² [J/m²]. The constants, here and below, may be plain numbers.
template <class T, class Lame>
T density(const Strain<T>& g, const Lame& lambda, const Lame& mu) {
  const T trace = g[0] + g[2];
  return Lame(0.5) * lambda * trace * trace + mu * (g[0] * g[0] + Lame(2.0) * g[1] * g[1] + g[2] * g[2]);
}

/// G = (FᵀF − I)/2 of the map from the rest plane that takes the corners to x.
template <class T, class Gradient>
Strain<T> strain(const std::array<Triple<T>, 3>& x, const std::array<std::array<Gradient, 2>, 3>& gradient) {
  std::array<Triple<T>, 2> f;
  for (std::size_t axis = 0; axis < 2; ++axis) f[axis] = gradient[0][axis] * x[0] + gradient[1][axis] * x[1] + gradient[2][axis] * x[2];
  return {Gradient(0.5) * (dot(f[0], f[0]) - T(1.0)), Gradient(0.5) * dot(f[0], f[1]), Gradient(0.5) * (dot(f[1], f[1]) - T(1.0))};
}

}  // namespace ogc::reference
