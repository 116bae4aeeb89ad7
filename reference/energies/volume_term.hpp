// The energy of a contact with a volume, as a function of the point and the triangle's corners (§3.9). The normal n and
// the weights w come from the detection and stay constant.
#pragma once

#include <algorithm>

#include "reference/energies/stencil_terms.hpp"

namespace ogc::reference {

/// A contact with a volume. Its vertices are the point, then the corners of the triangle.
struct VolumeTerm {
  std::array<compare::Index, 4> vertex{-1, -1, -1, -1};
  std::array<double, 4> weight{1, 0, 0, 0};  ///< 1, −w₁, −w₂, −w₃
  Triple<double> normal{}, start{};          ///< n; Σ wᵢ xᵢᵗ [m]
  double contact_radius = 0, stiffness = 0;  ///< r [m], k [N/m]
  double friction = 0, slip_limit = 0;       ///< μ [1], ε_v h [m]

  /// Returns r − φ [m]; `apart` is Σ wᵢ xᵢ.
  template <class T>
  T overlap(const Triple<T>& apart) const {
    return T(contact_radius) - (normal[0] * apart[0] + normal[1] * apart[1] + normal[2] * apart[2]);
  }
  /// Returns k/2 max(0, r − φ)² at the vertices [J].
  template <class T>
  T energy(const std::array<Triple<T>, 4>& x) const {
    const T depth = overlap(separation(weight, x));
    return plain(depth) > 0 ? 0.5 * stiffness * depth * depth : T(0.0);
  }
  /// Returns the contact's friction. Its normal force λ follows from the overlap at the positions x.
  FrictionTerm friction_at(const std::array<Triple<double>, 4>& x) const {
    const double force = friction * stiffness * std::max(0.0, overlap(separation(weight, x)));
    return {compare::ContactSides::point_triangle, vertex, weight, normal, start, force, slip_limit};
  }
};

}  // namespace ogc::reference
