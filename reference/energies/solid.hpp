// The energies of a tetrahedron over any number type (method.md §4.9, §8).
#pragma once

#include "reference/energies/derivative.hpp"

namespace ogc::reference {

/// The columns of F, 3×3.
template <class T>
using SolidDeformation = std::array<Triple<T>, 3>;

/// G by its components xx, xy, xz, yy, yz, zz.
template <class T>
using SolidStrain = std::array<T, 6>;

/// F of the map that takes the corners at rest to x.
template <class T, class Gradient>
SolidDeformation<T> solid_deformation(const std::array<Triple<T>, 4>& x,
                                      const std::array<std::array<Gradient, 3>, 4>& gradient) {
  SolidDeformation<T> f;
  for (std::size_t axis = 0; axis < 3; ++axis)
    f[axis] = gradient[0][axis] * x[0] + gradient[1][axis] * x[1] + gradient[2][axis] * x[2] + gradient[3][axis] * x[3];
  return f;
}

/// G = (FᵀF − I)/2.
template <class T>
SolidStrain<T> solid_strain(const SolidDeformation<T>& f) {
  const T one(1.0);
  return {0.5 * (dot(f[0], f[0]) - one), 0.5 * dot(f[0], f[1]), 0.5 * dot(f[0], f[2]),
          0.5 * (dot(f[1], f[1]) - one), 0.5 * dot(f[1], f[2]), 0.5 * (dot(f[2], f[2]) - one)};
}

/// ϕ(G) = λ/2 tr(G)² + μ ‖G‖² [J/m³]. The constants, here and below, may be plain numbers.
template <class T, class Lame>
T solid_quadratic(const SolidStrain<T>& g, const Lame& lambda, const Lame& mu) {
  const T trace = g[0] + g[3] + g[5];
  return Lame(0.5) * lambda * trace * trace +
         mu * (g[0] * g[0] + g[3] * g[3] + g[5] * g[5] + Lame(2.0) * (g[1] * g[1] + g[2] * g[2] + g[4] * g[4]));
}

/// μ/2 (‖F‖² − 3) − μ (J − 1) + (λ + μ)/2 (J − 1)² [J/m³]. Near rest the first two terms cancel, and their rounding
/// would be more than all of the energy of a solid in free fall. With J² = det(I + 2G) they are μ (tr(G) (J − 1) − 4 I₂
/// − 8 det G)/(J + 1), I₂ the sum of the principal minors of G, of second order term by term; where J is not positive
/// nothing cancels.
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

}  // namespace ogc::reference
