// A number type for the kernels' formulas that holds several floats in one register. It does the same operations in the
// same order as one float, and rounds each result in the same way, so all bits are the same. It uses g++'s vector
// types, and SSE2 or AVX2 instructions where these are better.
//
// Files that use packs are compiled for several machines, each in its own namespace. So the linker never merges code
// with AVX2 into code without it.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

#if defined(__AVX2__)
#include <immintrin.h>
#define OGC_PACKS packs_avx2
#define OGC_FOR_PACKS(name) name##_avx2
#else
#if defined(__SSE2__)
#include <emmintrin.h>
#endif
#define OGC_PACKS packs_baseline
#define OGC_FOR_PACKS(name) name##_baseline
#endif

#include "fast/kernels/arithmetic/scalar.hpp"

namespace ogc::fast {
inline namespace OGC_PACKS {

/// Names g++'s vector types of N numbers.
template <int N>
struct Register;
/// 16 B: a register of SSE2
template <>
struct Register<4> {
  using Numbers __attribute__((vector_size(16))) = float;
  using Bits __attribute__((vector_size(16))) = std::int32_t;
};
/// 32 B: a register of AVX2
template <>
struct Register<8> {
  using Numbers __attribute__((vector_size(32))) = float;
  using Bits __attribute__((vector_size(32))) = std::int32_t;
};

/// Holds N truth values.
template <int N>
struct PackMaskOf {
  using Bits = typename Register<N>::Bits;  ///< all bits set if true, none if false
  Bits bits{};                              ///< by lane

  friend PackMaskOf operator!(PackMaskOf a) { return {~a.bits}; }
  friend PackMaskOf operator&&(PackMaskOf a, PackMaskOf b) { return {a.bits & b.bits}; }
  friend PackMaskOf operator||(PackMaskOf a, PackMaskOf b) { return {a.bits | b.bits}; }

  /// Returns a bit for each lane that is true; the lowest bit is that of lane 0.
  friend unsigned true_lanes(PackMaskOf condition) {
#if defined(__AVX2__)
    if constexpr (N == 8) return static_cast<unsigned>(_mm256_movemask_ps(std::bit_cast<__m256>(condition.bits)));
#endif
#if defined(__SSE2__)
    if constexpr (N == 4) return static_cast<unsigned>(_mm_movemask_ps(std::bit_cast<__m128>(condition.bits)));
#endif
    unsigned all = 0;
    for (int k = 0; k < N; ++k) all |= condition.bits[k] != 0 ? 1U << k : 0U;
    return all;
  }
  friend bool is_false(PackMaskOf condition) { return true_lanes(condition) == 0; }
};

/// Holds N floats in one register, one in each lane.
template <int N>
struct PackOf {
  static constexpr int width = N;  ///< lanes
  using Numbers = typename Register<N>::Numbers;
  using Mask = PackMaskOf<N>;
  Numbers value{};  ///< by lane

  PackOf() = default;
  PackOf(Numbers packed) : value(packed) {}                    // NOLINT: formulas mix packs with constants
  PackOf(float everywhere) : value(everywhere - Numbers{}) {}  // NOLINT: subtracting +0 keeps the sign of a zero
  explicit PackOf(const float* from) { std::memcpy(&value, from, sizeof value); }
  /// Returns number(k) in lane k.
  template <class F>
  static PackOf of_each(F number) {
    return [&]<int... k>(std::integer_sequence<int, k...>) { return PackOf(Numbers{number(k)...}); }
    (std::make_integer_sequence<int, N>());
  }

  /// Writes lane k to to[k], which needs no alignment.
  void store(float* to) const { std::memcpy(to, &value, sizeof value); }
  float operator[](int k) const { return value[k]; }

  friend PackOf operator+(PackOf a, PackOf b) { return a.value + b.value; }
  friend PackOf operator-(PackOf a, PackOf b) { return a.value - b.value; }
  friend PackOf operator*(PackOf a, PackOf b) { return a.value * b.value; }
  friend PackOf operator/(PackOf a, PackOf b) { return a.value / b.value; }
  friend PackOf operator-(PackOf a) { return -a.value; }
  friend Mask operator>(PackOf a, PackOf b) { return {a.value > b.value}; }
  friend Mask operator<(PackOf a, PackOf b) { return {a.value < b.value}; }
  friend Mask operator<=(PackOf a, PackOf b) { return {a.value <= b.value}; }

  friend PackOf select(Mask condition, PackOf a, PackOf b) { return condition.bits ? a.value : b.value; }
  friend PackOf absolute(PackOf a) {
    return std::bit_cast<Numbers>(std::bit_cast<typename Mask::Bits>(a.value) & 0x7fffffff);
  }
  friend PackOf add(PackOf a, PackOf b) { return a + b; }
  friend PackOf rough_quotient(PackOf a, PackOf b) { return a / b; }
  friend PackOf rough_inverse_root(PackOf a) { return 1.0F / root(a); }

  friend PackOf root(PackOf a) {
#if defined(__AVX2__)
    if constexpr (N == 8) return Numbers(_mm256_sqrt_ps(a.value));
#endif
#if defined(__SSE2__)
    if constexpr (N == 4) return Numbers(_mm_sqrt_ps(a.value));
#endif
    return of_each([&a](int k) { return sqrtf(a[k]); });
  }
  friend PackOf smaller(PackOf a, PackOf b) {
#if defined(__AVX2__)
    if constexpr (N == 8) return Numbers(_mm256_min_ps(b.value, a.value));
#endif
#if defined(__SSE2__)
    if constexpr (N == 4) return Numbers(_mm_min_ps(b.value, a.value));
#endif
    return select(b < a, b, a);
  }
  friend PackOf larger(PackOf a, PackOf b) {
#if defined(__AVX2__)
    if constexpr (N == 8) return Numbers(_mm256_max_ps(b.value, a.value));
#endif
#if defined(__SSE2__)
    if constexpr (N == 4) return Numbers(_mm_max_ps(b.value, a.value));
#endif
    return select(a < b, b, a);
  }
};

/// Returns a() where the condition holds, else b(); computes both.
template <int N, class A, class B>
PackOf<N> choose(PackMaskOf<N> condition, const A& a, const B& b) {
  return select(condition, a(), b());
}

/// The pack for nodes of trees and for searches.
using Pack = PackOf<4>;

/// The widest pack that fits a register.
#if defined(__AVX2__)
using WidePack = PackOf<8>;
#else
using WidePack = PackOf<4>;
#endif

/// Returns a mask that is true in the first `count` lanes.
template <class P>
typename P::Mask first_of(int count) {
  using Bits = typename P::Mask::Bits;
  return [count]<int... k>(std::integer_sequence<int, k...>) { return typename P::Mask{Bits{k...} < count}; }
  (std::make_integer_sequence<int, P::width>());
}

/// Shuffles each block of 16 B (four numbers) separately. Block k of the result has the four numbers with indices p, q,
/// r and s. Index i < 4 means number i of block k of a, and index N + i means number i of block k of b.
template <int p, int q, int r, int s, int N>
PackOf<N> mixed(const PackOf<N>& a, const PackOf<N>& b) {
  return [&]<int... k>(std::integer_sequence<int, k...>) {
    constexpr int from[4] = {p, q, r, s};
    return PackOf<N>(__builtin_shuffle(a.value, b.value, typename PackMaskOf<N>::Bits{k / 4 * 4 + from[k % 4]...}));
  }
  (std::make_integer_sequence<int, N>());
}

/// The columns of four rows a, b, c and d, each block of 16 B separately.
template <int N>
struct ColumnsOf {
  /// in each block, x has number 0 of a, b, c and d, y has number 1, z number 2, and w number 3
  PackOf<N> x, y, z, w;
};
/// Returns the columns of four rows.
template <int N>
ColumnsOf<N> transposed(const PackOf<N>& a, const PackOf<N>& b, const PackOf<N>& c, const PackOf<N>& d) {
  const PackOf<N> xy_ab = mixed<0, N, 1, N + 1>(a, b), xy_cd = mixed<0, N, 1, N + 1>(c, d);
  const PackOf<N> zw_ab = mixed<2, N + 2, 3, N + 3>(a, b), zw_cd = mixed<2, N + 2, 3, N + 3>(c, d);
  return {mixed<0, 1, N, N + 1>(xy_ab, xy_cd), mixed<2, 3, N + 2, N + 3>(xy_ab, xy_cd),
          mixed<0, 1, N, N + 1>(zw_ab, zw_cd), mixed<2, 3, N + 2, N + 3>(zw_ab, zw_cd)};
}
using Columns = ColumnsOf<4>;

/// Joins two halves in registers. A pack that is read from two halves in memory would wait until both have been stored.
#if defined(__AVX2__)
/// Returns `low` in lanes 0 … 3 and `high` in lanes 4 … 7.
inline PackOf<8> halves(Pack low, Pack high) { return PackOf<8>::Numbers(_mm256_set_m128(high.value, low.value)); }
#endif

/// Returns x, y and z of P::width positions; each position is read as a whole.
template <class P>
[[gnu::always_inline]] inline Vector<P> transposed(const PaddedVec* const* position) {
  const auto whole = [position](int k) { return Pack(std::bit_cast<Pack::Numbers>(*position[k])); };
  const auto column = [&whole](int k) {  // positions k, k + 4, …
    if constexpr (P::width == 4)
      return whole(k);
    else
      return halves(whole(k), whole(k + 4));
  };
  const auto all = transposed(column(0), column(1), column(2), column(3));
  return {all.x, all.y, all.z};
}

}  // namespace OGC_PACKS

/// Makes packs compare lane by lane.
template <int N>
struct MaskOf<PackOf<N>> {
  using type = PackMaskOf<N>;
};

}  // namespace ogc::fast
