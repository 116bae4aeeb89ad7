// IPC's mollifier of nearly parallel edges (method.md §4.3), over any number type.
#pragma once

#include "reference/energies/derivative.hpp"

namespace ogc::reference {

/// The mollifier e_k = q (2 − q) with q = c/ε, c = ‖e × e'‖² and ε = 10⁻³ ‖ē‖²‖ē'‖² of the rest lengths. e_k is 1 for c
/// ≥ ε.
template <class T>
struct Mollifier {
  T sine, limit;  ///< c, ε [m⁴]
  Mollifier(const Triple<T>& e, const Triple<T>& f, const T& rest_squared_e, const T& rest_squared_f)
      : sine(dot(cross(e, f), cross(e, f))), limit(T(1e-3) * rest_squared_e * rest_squared_f) {}
  /// Returns whether e_k is below 1.
  bool acts() const { return plain(sine) < plain(limit); }
  /// Returns e_k; valid only if `acts`.
  T value() const {
    const T share = sine / limit;
    return share * (T(2.0) - share);
  }
};

}  // namespace ogc::reference
