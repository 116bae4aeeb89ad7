// Solves the 3×3 system of a vertex update.
#pragma once

#include "fast/kernels/arithmetic/accumulator.hpp"
#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// Returns x of H x = f by LDLᵀ without pivoting, for a symmetric positive definite H. H counts as indefinite if a
/// pivot is NaN or at most 4 · 2⁻²⁴ of its diagonal entry: the products subtracted from this entry err by as much. For
/// an indefinite H the result is f · `fallback`, a step down the gradient. With fallback = h²/m this is the step of
/// inertia alone.
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
