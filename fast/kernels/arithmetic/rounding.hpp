// Defines operations that are each rounded separately, never contracted to fused multiply-adds. The host never
// contracts operations (-ffp-contract=off). nvcc may contract any operations except the intrinsics used here. So
// detection gives the same bits on host and device in every build, not only in a `strict` one.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "fast/kernels/arithmetic/qualifiers.hpp"

namespace ogc::fast {

#if defined(__CUDA_ARCH__)
#define OGC_ROUNDED(on_device, on_host) return on_device
#else
#define OGC_ROUNDED(on_device, on_host) return on_host
#endif

/// Each function computes one IEEE operation, rounded to nearest and never contracted.
OGC_HD inline double add(double a, double b) { OGC_ROUNDED(__dadd_rn(a, b), a + b); }
OGC_HD inline double sub(double a, double b) { OGC_ROUNDED(__dsub_rn(a, b), a - b); }
OGC_HD inline double mul(double a, double b) { OGC_ROUNDED(__dmul_rn(a, b), a * b); }
OGC_HD inline double divide(double a, double b) { OGC_ROUNDED(__ddiv_rn(a, b), a / b); }
OGC_HD inline double square_root(double a) { OGC_ROUNDED(__dsqrt_rn(a), std::sqrt(a)); }
/// Returns a·b + c with one rounding.
OGC_HD inline double fused(double a, double b, double c) { OGC_ROUNDED(__fma_rn(a, b, c), std::fma(a, b, c)); }

/// Each function computes one IEEE operation in single precision, rounded to nearest and never contracted.
OGC_HD inline float add(float a, float b) { OGC_ROUNDED(__fadd_rn(a, b), a + b); }
OGC_HD inline float sub(float a, float b) { OGC_ROUNDED(__fsub_rn(a, b), a - b); }
OGC_HD inline float mul(float a, float b) { OGC_ROUNDED(__fmul_rn(a, b), a * b); }
OGC_HD inline float square_root(float a) { OGC_ROUNDED(__fsqrt_rn(a), std::sqrt(a)); }

#undef OGC_ROUNDED

/// Return minimum, maximum and |a|. If either argument is NaN, minimum and maximum return the first argument.
OGC_HD inline double smaller(double a, double b) { return b < a ? b : a; }
OGC_HD inline double larger(double a, double b) { return a < b ? b : a; }
OGC_HD inline double modulus(double a) { return a < 0 ? -a : a; }
OGC_HD inline float smaller(float a, float b) { return b < a ? b : a; }
OGC_HD inline float larger(float a, float b) { return a < b ? b : a; }

/// Returns the largest float that is not above a.
OGC_HD inline float round_down(double a) {
#if defined(__CUDA_ARCH__)
  return __double2float_rd(a);
#else
  const float nearest = static_cast<float>(a);
  if (!(static_cast<double>(nearest) > a)) return nearest;
  if (nearest == 0) return -std::numeric_limits<float>::denorm_min();
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(nearest) + (nearest > 0 ? -1 : 1));
#endif
}

/// Returns the smallest float that is not below a.
OGC_HD inline float round_up(double a) { return -round_down(-a); }

}  // namespace ogc::fast
