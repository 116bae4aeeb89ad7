// The activations (method.md §4.2): two stages (Eq. 18, 20; Eq. 19 corrected to k'_c = τ k_c (r − τ), method.md §1.1,
// with τ = r/2: k'_c = k_c r²/4) and the variants of the ablation. The kind is a constant wherever the default is
// swept, so that the switch costs it nothing.
#pragma once

#include <cmath>

#include "compare/problem/settings.hpp"
#include "fast/kernels/logarithm.hpp"
#include "fast/kernels/qualifiers.hpp"

namespace ogc::fast {

using compare::ContactActivation;

/// g' [N] and g'' [N/m] at distance d > 0 [m]: what a position needs, and no library function in it. 0 for d ≥ r; at d
/// = τ the quadratic stage.
template <class T>
struct ActivationSlopeOf {
  T slope{}, curvature{};
};
using ActivationSlope = ActivationSlopeOf<float>;

/// k'_c [J] of the logarithmic stage; as printed it is k_c r³/8.
template <class T>
OGC_HD T logarithmic_stiffness(ContactActivation kind, float r, const T& k) {
  const T stiffness = 0.25F * k * r * r;
  return kind == ContactActivation::ogc_as_printed ? 0.5F * r * stiffness : stiffness;
}

OGC_HD inline ActivationSlope activation_slope(ContactActivation kind, float d, float r, float k) {
  if (!(d < r)) return {};
  switch (kind) {
    case ContactActivation::quadratic: return {-k * (r - d), k};
    case ContactActivation::ipc_log: {
      const float depth = r - d, share = depth / d, log = 2.0F * log_ratio(r, d);
      return {-k * (depth * (log + share)), k * (log + share * (4.0F + share))};
    }
    case ContactActivation::cubic: {
      const float depth = r - d, slope = 2.0F * k / r * depth;
      return {-slope * depth, 2.0F * slope};
    }
    default: {
      if (d >= 0.5F * r) return {-k * (r - d), k};
      const float slope = logarithmic_stiffness(kind, r, k) / d;
      return {-slope, slope / d};
    }
  }
}

/// g [J]; the same cases. b of Eq. 20 is folded in: g = k'_c (log τ − log d) + k_c/2 (r − τ)².
OGC_HD inline float activation_energy(ContactActivation kind, float d, float r, float k) {
  if (!(d < r)) return 0;
  const float depth = r - d;
  switch (kind) {
    case ContactActivation::quadratic: return 0.5F * k * depth * depth;
    case ContactActivation::ipc_log: return k * depth * depth * log_ratio(r, d);
    case ContactActivation::cubic: return 2.0F * k / (3.0F * r) * depth * depth * depth;
    default: {
      if (d >= 0.5F * r) return 0.5F * k * depth * depth;
      return logarithmic_stiffness(kind, r, k) * log_ratio(0.5F * r, d) + 0.125F * k * r * r;
    }
  }
}

}  // namespace ogc::fast
