// Four floats at a time in one register of any x86-64 processor, as a number type of the kernels' formulas: the same operations in the same order as on one float, each
// rounded alike, so that the same bits come out.
#pragma once

#include <emmintrin.h>

#include "fast/kernels/scalar.hpp"

namespace ogc::fast {

/// True or false four times.
struct PackMask {
  __m128 bits = _mm_setzero_ps();

  friend PackMask operator!(PackMask a) { return {_mm_xor_ps(a.bits, _mm_castsi128_ps(_mm_set1_epi32(-1)))}; }
  friend PackMask operator&&(PackMask a, PackMask b) { return {_mm_and_ps(a.bits, b.bits)}; }
  friend PackMask operator||(PackMask a, PackMask b) { return {_mm_or_ps(a.bits, b.bits)}; }
};

struct Pack {
  static constexpr int width = 4;
  __m128 value = _mm_setzero_ps();

  Pack() = default;
  Pack(__m128 packed) : value(packed) {}  // NOLINT: formulas mix packs with constants
  Pack(float everywhere) : value(_mm_set1_ps(everywhere)) {}
  Pack(float a, float b, float c, float d) : value(_mm_setr_ps(a, b, c, d)) {}

  friend Pack operator+(Pack a, Pack b) { return _mm_add_ps(a.value, b.value); }
  friend Pack operator-(Pack a, Pack b) { return _mm_sub_ps(a.value, b.value); }
  friend Pack operator*(Pack a, Pack b) { return _mm_mul_ps(a.value, b.value); }
  friend Pack operator/(Pack a, Pack b) { return _mm_div_ps(a.value, b.value); }
  friend Pack operator-(Pack a) { return _mm_xor_ps(a.value, _mm_set1_ps(-0.0F)); }
  friend PackMask operator>(Pack a, Pack b) { return {_mm_cmpgt_ps(a.value, b.value)}; }
  friend PackMask operator<(Pack a, Pack b) { return {_mm_cmplt_ps(a.value, b.value)}; }
};

template <>
struct MaskOf<Pack> {
  using type = PackMask;
};

inline Pack select(PackMask condition, Pack a, Pack b) {
  return _mm_or_ps(_mm_and_ps(condition.bits, a.value), _mm_andnot_ps(condition.bits, b.value));
}
inline Pack absolute(Pack a) { return _mm_andnot_ps(_mm_set1_ps(-0.0F), a.value); }
inline Pack root(Pack a) { return _mm_sqrt_ps(a.value); }
inline Pack add(Pack a, Pack b) { return a + b; }
inline Pack smaller(Pack a, Pack b) { return _mm_min_ps(b.value, a.value); }
inline Pack larger(Pack a, Pack b) { return _mm_max_ps(b.value, a.value); }
inline Pack rough_quotient(Pack a, Pack b) { return a / b; }
inline Pack rough_inverse_root(Pack a) { return 1.0F / root(a); }
inline bool is_false(PackMask condition) { return _mm_movemask_ps(condition.bits) == 0; }

/// True in the first `count` places.
inline PackMask first_of(int count) { return {_mm_castsi128_ps(_mm_cmplt_epi32(_mm_setr_epi32(0, 1, 2, 3), _mm_set1_epi32(count)))}; }

}  // namespace ogc::fast
