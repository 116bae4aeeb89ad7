// The barrier energy of IPC (Li et al. 2020, Eq. 6; with a thickness Li et al. 2021, Eq. 10), for any number type. It
// is a function of the squared distance D, which is a polynomial or a quotient of polynomials; the distance would need
// a root. With a thickness ξ the gap D − ξ² replaces D, and 2 ξ d̂ + d̂² replaces d̂². The barrier then acts for ξ < d
// < ξ + d̂.
#pragma once

#include <cmath>
#include <tuple>

#include "reference/energies/closest_form.hpp"
#include "reference/energies/mollifier.hpp"
#include "reference/energies/second.hpp"

namespace ogc::reference {

/// d̂ and ξ [m].
struct BarrierShape {
  double distance = 0, thickness = 0;
  /// Returns the distance at which the energy ends, ξ + d̂ [m].
  double reach() const { return thickness + distance; }
  double support() const { return distance * (distance + 2 * thickness); }                        ///< H [m²]
  double gap(double squared_distance) const { return squared_distance - thickness * thickness; }  ///< D − ξ² [m²]
};

/// Returns b(g) = −(g − H)² ln(g/H) [m⁴] for a gap 0 < g < H [m²]; 0 for g ≥ H.
template <class T>
T barrier(const T& gap, double support) {
  using std::log;
  if (plain(gap) >= support) return T(0.0);
  const T depth = gap - T(support);
  return -(depth * depth * log(1 / support * gap));
}

/// Returns b [m⁴], b' [m²] and b'' [1] at `gap` [m²].
template <class Number>
Second<1, Number> barrier_slopes(const Number& gap, double support) {
  Second<1, Number> variable(gap);
  variable.slope[0] = 1.0;
  return barrier(variable, support);
}

/// Returns the squared distance of the points, lines or planes that `form` selects [m²]. Its kind must not be
/// `fixed_weights`.
template <class T, std::size_t N>
T squared_form_distance(const ClosestForm& form, const std::array<Triple<T>, N>& x) {
  const auto at = [&](std::size_t place) -> const Triple<T>& { return x[form.at[place]]; };
  if (form.kind == FormKind::points) {
    const Triple<T> apart = at(0) - at(1);
    return dot(apart, apart);
  }
  if (form.kind == FormKind::point_line) {
    const Triple<T> edge = at(2) - at(1), normal = cross(edge, at(0) - at(1));
    return dot(normal, normal) / dot(edge, edge);
  }
  const bool plane = form.kind == FormKind::point_plane;
  const Triple<T> normal = plane ? cross(at(2) - at(1), at(3) - at(1)) : cross(at(1) - at(0), at(3) - at(2));
  const T height = dot(normal, plane ? at(0) - at(1) : at(2) - at(0));
  return height * height / dot(normal, normal);
}

/// One barrier without κ: w e_k b(D − ξ²), with the weight w and the squared distance D.
template <class Number>
struct BarrierTermOf {
  /// indices of the vertices, in the order of `form`; unused elements are −1
  std::array<compare::Index, 4> vertex{-1, -1, -1, -1};
  std::uint8_t count = 0;     ///< number of vertices
  ClosestForm form;           ///< the closest points, with a weight for each vertex
  Number weight = 1.0;        ///< number of pairs of primitives that share this barrier
  Number rest_squared = 0.0;  ///< ‖ē‖²‖ē'‖² if the pair is two mollified edges [m⁴]; 0: e_k = 1

  /// Returns the energy without κ [m⁴].
  template <class T, std::size_t N>
  T energy(const BarrierShape& shape, const std::array<Triple<T>, N>& x) const {
    const T gap = squared_form_distance(form, x) - T(shape.thickness * shape.thickness);
    const auto slopes = barrier_slopes(plain(gap), shape.support());
    const T value = weight * composed_energy(slopes, gap);
    if constexpr (N == 4) {
      if (rest_squared > 0.0) return value * Mollifier<T>(x[1] - x[0], x[3] - x[2], T(rest_squared), T(1.0)).value();
    }
    return value;
  }

  /// Lists the constants (`numbers`), and the properties that barriers evaluated together must share (`kinds`); see
  /// energies/stencil_terms.hpp.
  auto numbers() { return std::tie(weight, rest_squared); }
  auto numbers() const { return std::tie(weight, rest_squared); }
  auto kinds() { return std::tie(form.kind, form.at); }
  auto kinds() const { return std::tie(form.kind, form.at); }

 private:
  static double composed_energy(const Second<1>& slopes, double) { return slopes.value; }
  template <std::size_t N, class V>
  static Second<N, V> composed_energy(const Second<1, V>& slopes, const Second<N, V>& gap) {
    return composed(slopes.value, slopes.slope[0], slopes.bend(0), gap);
  }
};
/// A barrier over doubles.
using BarrierTerm = BarrierTermOf<double>;

}  // namespace ogc::reference
