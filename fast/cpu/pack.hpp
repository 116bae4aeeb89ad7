// Four floats at a time in one register, as a number type of the kernels' formulas: the same operations in the same order as on one float, each rounded alike, so that the
// same bits come out. g++'s vector types, which every processor has; a few operations have better instructions where there is SSE2.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "fast/kernels/scalar.hpp"

namespace ogc::fast {

/// True or false four times.
struct PackMask {
  using Bits __attribute__((vector_size(16))) = std::int32_t;  ///< all ones or none
  Bits bits{};

  friend PackMask operator!(PackMask a) { return {~a.bits}; }
  friend PackMask operator&&(PackMask a, PackMask b) { return {a.bits & b.bits}; }
  friend PackMask operator||(PackMask a, PackMask b) { return {a.bits | b.bits}; }
};

struct Pack {
  static constexpr int width = 4;
  using Numbers __attribute__((vector_size(16))) = float;
  Numbers value{};

  Pack() = default;
  Pack(Numbers packed) : value(packed) {}  // NOLINT: formulas mix packs with constants
  Pack(float everywhere) : value{everywhere, everywhere, everywhere, everywhere} {}
  Pack(float a, float b, float c, float d) : value{a, b, c, d} {}
  explicit Pack(const float* from) { std::memcpy(&value, from, sizeof value); }
  explicit Pack(const Place& whole) : value(std::bit_cast<Numbers>(whole)) {}

  void store(float* to) const { std::memcpy(to, &value, sizeof value); }
  float operator[](int k) const { return value[k]; }

  friend Pack operator+(Pack a, Pack b) { return a.value + b.value; }
  friend Pack operator-(Pack a, Pack b) { return a.value - b.value; }
  friend Pack operator*(Pack a, Pack b) { return a.value * b.value; }
  friend Pack operator/(Pack a, Pack b) { return a.value / b.value; }
  friend Pack operator-(Pack a) { return -a.value; }
  friend PackMask operator>(Pack a, Pack b) { return {a.value > b.value}; }
  friend PackMask operator<(Pack a, Pack b) { return {a.value < b.value}; }
  friend PackMask operator<=(Pack a, Pack b) { return {a.value <= b.value}; }
};

template <>
struct MaskOf<Pack> {
  using type = PackMask;
};

inline Pack select(PackMask condition, Pack a, Pack b) { return condition.bits ? a.value : b.value; }
inline Pack absolute(Pack a) { return std::bit_cast<Pack::Numbers>(std::bit_cast<PackMask::Bits>(a.value) & 0x7fffffff); }
inline Pack add(Pack a, Pack b) { return a + b; }

#if defined(__SSE2__)
inline Pack root(Pack a) { return _mm_sqrt_ps(a.value); }
inline Pack smaller(Pack a, Pack b) { return _mm_min_ps(b.value, a.value); }
inline Pack larger(Pack a, Pack b) { return _mm_max_ps(b.value, a.value); }
/// A bit for each place that is true, the first one's lowest.
inline unsigned places(PackMask condition) { return static_cast<unsigned>(_mm_movemask_ps(std::bit_cast<__m128>(condition.bits))); }
#else
inline Pack root(Pack a) { return {sqrtf(a[0]), sqrtf(a[1]), sqrtf(a[2]), sqrtf(a[3])}; }
inline Pack smaller(Pack a, Pack b) { return select(b < a, b, a); }
inline Pack larger(Pack a, Pack b) { return select(a < b, b, a); }
inline unsigned places(PackMask condition) {
  const PackMask::Bits bits = condition.bits & PackMask::Bits{1, 2, 4, 8};
  return static_cast<unsigned>(bits[0] | bits[1] | bits[2] | bits[3]);
}
#endif

inline bool is_false(PackMask condition) { return places(condition) == 0; }

inline Pack rough_quotient(Pack a, Pack b) { return a / b; }
inline Pack rough_inverse_root(Pack a) { return 1.0F / root(a); }

/// The first numbers of four packs, their second ones, and so on.
struct Columns {
  Pack x, y, z, w;
};
inline Columns transposed(const Pack& a, const Pack& b, const Pack& c, const Pack& d) {
  using Bits = PackMask::Bits;
  const auto xy_ab = __builtin_shuffle(a.value, b.value, Bits{0, 4, 1, 5}), xy_cd = __builtin_shuffle(c.value, d.value, Bits{0, 4, 1, 5});
  const auto zw_ab = __builtin_shuffle(a.value, b.value, Bits{2, 6, 3, 7}), zw_cd = __builtin_shuffle(c.value, d.value, Bits{2, 6, 3, 7});
  return {__builtin_shuffle(xy_ab, xy_cd, Bits{0, 1, 4, 5}), __builtin_shuffle(xy_ab, xy_cd, Bits{2, 3, 6, 7}),
          __builtin_shuffle(zw_ab, zw_cd, Bits{0, 1, 4, 5}), __builtin_shuffle(zw_ab, zw_cd, Bits{2, 3, 6, 7})};
}

/// The x, the y and the z of four places, each of which is read whole.
inline Vector<Pack> transposed(const Place& a, const Place& b, const Place& c, const Place& d) {
  const Columns all = transposed(Pack(a), Pack(b), Pack(c), Pack(d));
  return {all.x, all.y, all.z};
}

/// True in the first `count` places.
inline PackMask first_of(int count) { return {PackMask::Bits{0, 1, 2, 3} < count}; }

}  // namespace ogc::fast
