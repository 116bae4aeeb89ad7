// Computes gradient and Hessian of a stencil over all of its vertices. Energies are invariant under translations, so
// derivatives are taken in coordinates orthogonal to all translations. This saves three variables. The smaller matrix
// has the eigenvalues of the whole matrix except three zeros.
#pragma once

#include <array>

#include "compare/problem/settings.hpp"
#include "reference/energies/second.hpp"

namespace ogc::reference {

/// How Newton's method makes a stencil's Hessian positive semidefinite: not at all, by setting negative eigenvalues to
/// 0, or to their absolute values.
enum class HessianProjection : std::uint8_t { none, clamp, absolute };

/// Derivatives of a stencil of n ≤ 4 vertices: gradient [N] in 3n entries, Hessian [N/m] in rows of 12 numbers. The
/// first 3n numbers of a row are used.
struct StencilDerivatives {
  double energy = 0;
  std::array<double, 12> gradient{};
  std::array<double, 144> hessian{};
};

/// `coordinate_count` is the number of coordinates that remain without translations. `without_translation` returns the
/// matrix q of one axis: coordinate d is Σₖ q[k][d] xₖ over the vertices k. The columns are orthonormal, and each
/// column adds up to 0. q[k][d] is 0 for k > d + 1.
template <std::size_t Count>
constexpr std::size_t coordinate_count = 3 * (Count - 1);
template <std::size_t Count>
constexpr std::array<std::array<double, Count - 1>, Count> without_translation() {
  // 1/√((d + 1)(d + 2))
  constexpr std::array<double, 3> share{0.70710678118654752440, 0.40824829046386301637, 0.28867513459481288225};
  std::array<std::array<double, Count - 1>, Count> q{};
  for (std::size_t d = 0; d + 1 < Count; ++d) {
    for (std::size_t k = 0; k <= d; ++k) q[k][d] = share[d];
    q[d + 1][d] = -static_cast<double>(d + 1) * share[d];
  }
  return q;
}

/// Makes the symmetric matrix of `size` rows positive semidefinite in place; row-major. `none` leaves it unchanged.
/// Throws std::invalid_argument for sizes other than 3, 6 and 9.
void project(double* matrix, std::size_t size, HessianProjection projection);

/// Returns the stencil's vertices as variables. Positions are relative to the first vertex, which changes only
/// roundings.
template <std::size_t Count>
std::array<Triple<Second<coordinate_count<Count>>>, Count> stencil_variables(
    const std::array<Triple<double>, Count>& x) {
  static constexpr auto q = without_translation<Count>();
  std::array<Triple<Second<coordinate_count<Count>>>, Count> variables;
  for (std::size_t k = 0; k < Count; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      variables[k][axis].value = x[k][axis] - x[0][axis];
      for (std::size_t d = 0; d + 1 < Count; ++d) variables[k][axis].slope[3 * d + axis] = q[k][d];
    }
  return variables;
}

/// Transforms derivatives from the reduced coordinates back to the vertices.
template <std::size_t Count>
StencilDerivatives expanded(const Second<coordinate_count<Count>>& energy, HessianProjection projection) {
  constexpr std::size_t size = coordinate_count<Count>;
  static constexpr auto q = without_translation<Count>();
  std::array<double, size * size> reduced;
  for (std::size_t i = 0, k = 0; i < size; ++i)
    for (std::size_t j = 0; j <= i; ++j, ++k) reduced[i * size + j] = reduced[j * size + i] = energy.bend(k);
  project(reduced.data(), size, projection);
  StencilDerivatives result;
  result.energy = energy.value;
  std::array<double, 3 * Count * size> half{};
  for (std::size_t k = 0; k < Count; ++k)
    for (std::size_t d = 0; d + 1 < Count; ++d)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        result.gradient[3 * k + axis] += q[k][d] * energy.slope[3 * d + axis];
        for (std::size_t j = 0; j < size; ++j)
          half[(3 * k + axis) * size + j] += q[k][d] * reduced[(3 * d + axis) * size + j];
      }
  for (std::size_t i = 0; i < 3 * Count; ++i)
    for (std::size_t k = 0; k < Count; ++k)
      for (std::size_t d = 0; d + 1 < Count; ++d)
        for (std::size_t axis = 0; axis < 3; ++axis)
          result.hessian[12 * i + 3 * k + axis] += half[i * size + 3 * d + axis] * q[k][d];
  return result;
}

/// Returns the derivatives of a stencil. `energy` maps the stencil's vertices to a number of their type, and must be
/// invariant under translations.
template <std::size_t Count, class Energy>
StencilDerivatives stencil_derivatives(const std::array<Triple<double>, Count>& x, HessianProjection projection,
                                       Energy energy) {
  return expanded<Count>(energy(stencil_variables<Count>(x)), projection);
}

}  // namespace ogc::reference
