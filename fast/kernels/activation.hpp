// The two-stage activation (Eq. 18, 20; Eq. 19 corrected to k'_c = τ k_c (r − τ), method.md §1, with τ = r/2: k'_c = k_c r²/4).
#pragma once

#include <cmath>

#include "fast/kernels/qualifiers.hpp"

namespace ogc::fast {

/// g' [N] and g'' [N/m] at distance d > 0 [m]: what a position needs, and no library function in it. 0 for d ≥ r; at d = τ the quadratic stage.
struct ActivationSlope {
  float slope = 0, curvature = 0;
};

OGC_HD inline ActivationSlope activation_slope(float d, float r, float k) {
  if (!(d < r)) return {};
  if (d >= 0.5F * r) return {-k * (r - d), k};
  const float slope = 0.25F * k * r * r / d;
  return {-slope, slope / d};
}

/// g [J]; the same cases. b of Eq. 20 is folded in: g = k'_c (log τ − log d) + k_c/2 (r − τ)².
OGC_HD inline float activation_energy(float d, float r, float k) {
  if (!(d < r)) return 0;
  if (d >= 0.5F * r) return 0.5F * k * (r - d) * (r - d);
  return 0.25F * k * r * r * logf(0.5F * r / d) + 0.125F * k * r * r;
}

}  // namespace ogc::fast
