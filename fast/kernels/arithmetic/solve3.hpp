// Solves the 3×3 system of a vertex update.
#pragma once

#include "fast/kernels/arithmetic/accumulator.hpp"
#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// Holds the factors of a symmetric H = LDLᵀ, without pivoting. H counts as indefinite if a pivot is NaN or at most 4 ·
/// 2⁻²⁴ of its diagonal entry: the products subtracted from this entry err by as much.
struct Factors {
  float l21, l31, l32, d1, d2, d3;  ///< entries of L and D
  bool is_definite;                 ///< false: H counts as indefinite, and the entries must not be used
};

/// Returns the factors of H.
OGC_HD inline Factors factors_of(const Symmetric3& h) {
  constexpr float noise = 4 * 0x1p-24f;
  Factors all{0, 0, 0, h.xx, 0, 0, false};
  if (!(h.xx > 0)) return all;
  all.l21 = h.xy / h.xx, all.l31 = h.xz / h.xx;
  all.d2 = h.yy - all.l21 * h.xy;
  if (!(all.d2 > noise * h.yy)) return all;
  const float u32 = h.yz - all.l31 * h.xy;
  all.l32 = u32 / all.d2;
  all.d3 = h.zz - all.l31 * h.xz - all.l32 * u32;
  all.is_definite = all.d3 > noise * h.zz;
  return all;
}

/// Returns x of H x = f. For an indefinite H the result is f · `fallback`, a step down the gradient. With fallback =
/// h²/m this is the step of inertia alone.
OGC_HD inline Vec solve(const Factors& h, const Vec& f, float fallback) {
  if (!h.is_definite) return fallback * f;
  const float y2 = f.y - h.l21 * f.x, y3 = f.z - h.l31 * f.x - h.l32 * y2;
  const float z = y3 / h.d3, y = y2 / h.d2 - h.l32 * z;
  return {f.x / h.d1 - h.l21 * y - h.l31 * z, y, z};
}

/// Returns solve(factors_of(H), f, fallback). Written out, so that a device's compiler needs one reciprocal for each
/// pivot: an update waits for this solve.
OGC_HD inline Vec solve_symmetric(const Symmetric3& h, const Vec& f, float fallback) {
  constexpr float noise = 4 * 0x1p-24f;
  const Vec gradient_step = fallback * f;
  if (!(h.xx > 0)) return gradient_step;
  const float l21 = h.xy / h.xx, l31 = h.xz / h.xx;
  const float d2 = h.yy - l21 * h.xy;
  if (!(d2 > noise * h.yy)) return gradient_step;
  const float u32 = h.yz - l31 * h.xy, l32 = u32 / d2;
  const float d3 = h.zz - l31 * h.xz - l32 * u32;
  if (!(d3 > noise * h.zz)) return gradient_step;
  const float y2 = f.y - l21 * f.x, y3 = f.z - l31 * f.x - l32 * y2;
  const float z = y3 / d3, y = y2 / d2 - l32 * z;
  return {f.x / h.xx - l21 * y - l31 * z, y, z};
}

}  // namespace ogc::fast
