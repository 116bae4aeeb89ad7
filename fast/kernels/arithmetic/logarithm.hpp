// Computes ln of a ratio itself, because library versions differ between host and device and a slope feeds positions
// (method.md §7.5).
#pragma once

#include <cstdint>
#include <cstring>

#include "fast/kernels/arithmetic/qualifiers.hpp"

namespace ogc::fast {

/// Returns 2 artanh(s) for |s| ≤ 1/3: 2 s (1 + s² P(s²)), with an error of at most 2 u. P, a minimax fit of
/// (artanh(s)/s − 1)/s² on s² ≤ 1/9, is off by 0.1 u of the whole, the last sum by 1 u, and its smaller term, at most
/// 0.04 of it, by a few.
OGC_HD inline float twice_artanh(float s) {
  const float z = s * s;
  const float p = 0.33333209f + z * (0.20010763f + z * (0.14000903f + z * 0.14005993f));
  return 2.0f * (s + s * (z * p));
}

/// Returns ln(r/d) for r ≥ d > 0, normal numbers, with an error of at most 5 u. Up to r = 2 d it is taken of the
/// quotient (r − d)/(r + d) itself, so that nothing cancels as d tends to r; beyond, of r/d = 2ᵉ m with √½ ≤ m < √2,
/// where the result is at least ln 2 and the quotient's rounding, u, at most 1.5 u of it.
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
