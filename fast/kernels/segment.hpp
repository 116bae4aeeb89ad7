// Computes the distance of a point and a closed segment in rounded double, for the distances of both kinds of pairs.
#pragma once

#include "fast/kernels/arithmetic/exact_sign.hpp"

namespace ogc::fast {

/// A vector of doubles whose operations are never contracted.
using Real = Vector<Rounded>;

/// Holds a computed distance, and a bound of its error.
struct Distance {
  double value = 0, slack = 0;  ///< [m]: the exact distance lies within value ± slack

  /// `may_be_within` returns whether the exact distance may be below r, `is_surely_within` whether it certainly is.
  OGC_HD bool may_be_within(float r) const { return sub(value, slack) < static_cast<double>(r); }
  OGC_HD bool is_surely_within(float r) const { return add(value, slack) < static_cast<double>(r); }
  /// Returns a lower bound of the exact distance.
  OGC_HD float below() const {
    const double low = sub(value, slack);
    return low > 0 ? round_down(low) : 0.0F;
  }
};

/// Returns ‖a‖₁.
OGC_HD inline double norm_1(const Real& a) {
  return add(add(modulus(a.x.value), modulus(a.y.value)), modulus(a.z.value));
}

/// Returns ‖a‖²; each operation is rounded.
OGC_HD inline double squared(const Real& a) { return dot(a, a).value; }

/// Returns the parameter in [0, 1] of the point of a segment ab closest to x; 0 if the segment has no length. u is x −
/// a, e is b − a.
OGC_HD inline double segment_parameter(const Real& u, const Real& e) {
  const double along = dot(u, e).value, whole = squared(e);
  if (!(along > 0)) return 0;
  return along < whole ? divide(along, whole) : 1;
}

/// Returns the squared distance of x and the closed segment ab; u is x − a, e is b − a. Its root errs by less than 2⁻⁴⁸
/// (‖u‖ + ‖e‖): 12 roundings of ‖u‖/‖e‖ in the parameter, 8 roundings of ‖u‖ in the difference and the norm.
OGC_HD inline double squared_to_segment(const Real& u, const Real& e) {
  return squared(u - Rounded{segment_parameter(u, e)} * e);
}

}  // namespace ogc::fast
