// Computes ln of a ratio without a library: library versions differ between host and device, and positions depend on
// the slope of the activation, which contains ln (method.md §7.5).
#pragma once

#include <cstdint>
#include <cstring>

#include "fast/kernels/arithmetic/qualifiers.hpp"

namespace ogc::fast {

/// Returns 2 artanh(s) for |s| ≤ 1/3 as 2 s (1 + s² P(s²)), with an error of at most 2 u, u = 2⁻²⁴. P is a minimax fit
/// of (artanh(s)/s − 1)/s² on s² ≤ 1/9. The fit errs by 0.1 u of the result, and the last sum by 1 u. The smaller term
/// of this sum errs by a few u of itself, and is at most 0.04 of the result.
OGC_HD inline float twice_artanh(float s) {
  const float z = s * s;
  const float p = 0.33333209f + z * (0.20010763f + z * (0.14000903f + z * 0.14005993f));
  return 2.0f * (s + s * (z * p));
}

/// Returns ln(r/d) for normal numbers r ≥ d > 0, with an error of at most 5 u, u = 2⁻²⁴. Up to r = 2 d it is computed
/// from the quotient (r − d)/(r + d), so that no digits cancel as d approaches r. For larger r it is computed from r/d
/// = 2ᵉ m with √½ ≤ m < √2. There ln(r/d) ≥ ln 2, so that the rounding error u of the quotient is at most 1.5 u of the
/// result.
OGC_HD inline float log_ratio(float r, float d) {
  if (r < 2.0f * d) return twice_artanh((r - d) / (r + d));
  constexpr std::uint32_t half_root = 0x3f3504f3u, mantissa = 0x007fffffu;  // √½
  const float ratio = r / d;
  std::uint32_t bits;
  std::memcpy(&bits, &ratio, sizeof bits);
  const std::uint32_t shifted = bits - half_root;
  const std::uint32_t reduced = (shifted & mantissa) + half_root;
  const int exponent = static_cast<int>(shifted >> 23);
  float m;
  std::memcpy(&m, &reduced, sizeof m);
  return static_cast<float>(exponent) * 0.69314718f + twice_artanh((m - 1.0f) / (m + 1.0f));
}

}  // namespace ogc::fast
