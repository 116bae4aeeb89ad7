// Makes one number type of several doubles side by side in vector registers, so that the code that differentiates one
// stencil differentiates several of one kind. Each lane does what a double would do, operation by operation: no result
// depends on the width, or on the contents of the other lanes.
//
// Branches. A comparison gives a mask. If all lanes agree, the mask decides a branch. Otherwise the branch is taken as
// if the mask were false, and `lanes_differ` is set: the caller then evaluates each lane alone.
//
// A file that uses lanes may be compiled for several instruction sets. Each has its own namespace, so that the linker
// never puts instructions into a program that its machine lacks.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <immintrin.h>
#endif

#ifdef __AVX2__
#define OGC_LANES lanes_avx2
#define OGC_FOR_LANES(name) name##_avx2
#else
#define OGC_LANES lanes_baseline
#define OGC_FOR_LANES(name) name##_baseline
#endif

namespace ogc::reference {
inline namespace OGC_LANES {

#ifdef __AVX2__
constexpr std::size_t pack_width = 4;
#else
constexpr std::size_t pack_width = 2;
#endif

using Pack [[gnu::vector_size(8 * pack_width)]] = double;
using PackBits [[gnu::vector_size(8 * pack_width)]] = std::int64_t;

/// Whether lanes have disagreed at a branch since a caller cleared this flag.
inline constinit thread_local bool lanes_differ = false;

/// The result of a comparison of lanes: all bits of a lane are set, or none.
template <std::size_t Packs>
struct Mask {
  PackBits part[Packs];

  bool any() const {
    PackBits all = part[0];
    for (std::size_t p = 1; p < Packs; ++p) all |= part[p];
    return !is_zero(all);
  }
  bool all() const {
    PackBits each = part[0];
    for (std::size_t p = 1; p < Packs; ++p) each &= part[p];
    return is_zero(~each);
  }
  /// Decides a branch.
  explicit operator bool() const {
    if (!any()) return false;
    if (all()) return true;
    lanes_differ = true;
    return false;
  }
  friend Mask operator&&(Mask a, const Mask& b) {
    for (std::size_t p = 0; p < Packs; ++p) a.part[p] &= b.part[p];
    return a;
  }
  friend Mask operator||(Mask a, const Mask& b) {
    for (std::size_t p = 0; p < Packs; ++p) a.part[p] |= b.part[p];
    return a;
  }
  friend Mask operator!(Mask a) {
    for (std::size_t p = 0; p < Packs; ++p) a.part[p] = ~a.part[p];
    return a;
  }

 private:
  static bool is_zero(PackBits bits) {
#ifdef __AVX2__
    return _mm256_testz_si256(reinterpret_cast<__m256i>(bits), reinterpret_cast<__m256i>(bits)) != 0;
#else
    return (bits[0] | bits[1]) == 0;
#endif
  }
};

/// `Packs` vector registers as one number.
template <std::size_t Packs>
struct Lanes {
  static constexpr std::size_t width = Packs * pack_width;
  Pack part[Packs];

  Lanes() = default;
  // Copies pack by pack, because g++ would copy halves of packs, and a load that spans two stores waits until both are
  // in the cache.
  Lanes(const Lanes& other) {
    for (std::size_t p = 0; p < Packs; ++p) part[p] = other.part[p];
  }
  Lanes& operator=(const Lanes& other) {
    for (std::size_t p = 0; p < Packs; ++p) part[p] = other.part[p];
    return *this;
  }
  Lanes(double value) {
    for (Pack& pack : part) pack = everywhere(value);
  }
  /// Loads `width` consecutive doubles.
  static Lanes load(const double* from) {
    Lanes x;
    std::memcpy(x.part, from, sizeof x.part);
    return x;
  }
  void store(double* to) const { std::memcpy(to, part, sizeof part); }

  friend Lanes operator+(Lanes a, const Lanes& b) {
    for (std::size_t p = 0; p < Packs; ++p) a.part[p] += b.part[p];
    return a;
  }
  friend Lanes operator-(Lanes a, const Lanes& b) {
    for (std::size_t p = 0; p < Packs; ++p) a.part[p] -= b.part[p];
    return a;
  }
  friend Lanes operator*(Lanes a, const Lanes& b) {
    for (std::size_t p = 0; p < Packs; ++p) a.part[p] *= b.part[p];
    return a;
  }
  friend Lanes operator/(Lanes a, const Lanes& b) {
    for (std::size_t p = 0; p < Packs; ++p) a.part[p] /= b.part[p];
    return a;
  }
  friend Lanes operator-(Lanes a) {
    for (Pack& pack : a.part) pack = -pack;
    return a;
  }
  Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
  Lanes& operator-=(const Lanes& b) { return *this = *this - b; }
  Lanes& operator*=(const Lanes& b) { return *this = *this * b; }

  friend Mask<Packs> operator<(const Lanes& a, const Lanes& b) {
    Mask<Packs> m;
    for (std::size_t p = 0; p < Packs; ++p) m.part[p] = less(a.part[p], b.part[p]);
    return m;
  }
  friend Mask<Packs> operator<=(const Lanes& a, const Lanes& b) {
    Mask<Packs> m;
    for (std::size_t p = 0; p < Packs; ++p) m.part[p] = at_most(a.part[p], b.part[p]);
    return m;
  }
  friend Mask<Packs> operator==(const Lanes& a, const Lanes& b) {
    Mask<Packs> m;
    for (std::size_t p = 0; p < Packs; ++p) m.part[p] = equal(a.part[p], b.part[p]);
    return m;
  }
  friend Mask<Packs> operator>(const Lanes& a, const Lanes& b) { return b < a; }
  friend Mask<Packs> operator>=(const Lanes& a, const Lanes& b) { return b <= a; }

  friend Lanes select(const Mask<Packs>& where, const Lanes& a, const Lanes& b) {
    Lanes x;
    for (std::size_t p = 0; p < Packs; ++p) x.part[p] = chosen(where.part[p], a.part[p], b.part[p]);
    return x;
  }
  friend Lanes abs(Lanes a) {
    for (Pack& pack : a.part) pack = reinterpret_cast<Pack>(reinterpret_cast<PackBits>(pack) & INT64_MAX);
    return a;
  }
  friend Lanes max(const Lanes& a, const Lanes& b) { return select(a < b, b, a); }
  friend Lanes sqrt(Lanes a) {
    for (Pack& pack : a.part) {
#if defined(__AVX2__)
      pack = _mm256_sqrt_pd(pack);
#elif defined(__SSE2__)
      pack = _mm_sqrt_pd(pack);
#else
      for (std::size_t i = 0; i < pack_width; ++i) pack[i] = std::sqrt(pack[i]);
#endif
    }
    return a;
  }
  friend Lanes log(Lanes a) {
    for (Pack& pack : a.part)
      for (std::size_t i = 0; i < pack_width; ++i) pack[i] = std::log(pack[i]);
    return a;
  }
  friend Lanes atan2(Lanes y, const Lanes& x) {
    for (std::size_t p = 0; p < Packs; ++p)
      for (std::size_t i = 0; i < pack_width; ++i) y.part[p][i] = std::atan2(y.part[p][i], x.part[p][i]);
    return y;
  }
  /// Returns −1 where a < 0, else 1.
  friend Lanes sign_of(const Lanes& a) { return select(a < Lanes(0.0), Lanes(-1.0), Lanes(1.0)); }
  friend Lanes plain(const Lanes& a) { return a; }

 private:
  static Pack everywhere(double value) {
    Pack pack{};
    for (std::size_t i = 0; i < pack_width; ++i) pack[i] = value;
    return pack;
  }
  // Uses intrinsics, because g++ 12 fails on a comparison of vectors with -frounding-math (an internal error).
#if defined(__AVX2__)
  static PackBits less(Pack a, Pack b) { return reinterpret_cast<PackBits>(_mm256_cmp_pd(a, b, _CMP_LT_OQ)); }
  static PackBits at_most(Pack a, Pack b) { return reinterpret_cast<PackBits>(_mm256_cmp_pd(a, b, _CMP_LE_OQ)); }
  static PackBits equal(Pack a, Pack b) { return reinterpret_cast<PackBits>(_mm256_cmp_pd(a, b, _CMP_EQ_OQ)); }
#elif defined(__SSE2__)
  static PackBits less(Pack a, Pack b) { return reinterpret_cast<PackBits>(_mm_cmplt_pd(a, b)); }
  static PackBits at_most(Pack a, Pack b) { return reinterpret_cast<PackBits>(_mm_cmple_pd(a, b)); }
  static PackBits equal(Pack a, Pack b) { return reinterpret_cast<PackBits>(_mm_cmpeq_pd(a, b)); }
#else
  static PackBits less(Pack a, Pack b) { return a < b; }
  static PackBits at_most(Pack a, Pack b) { return a <= b; }
  static PackBits equal(Pack a, Pack b) { return a == b; }
#endif
  static Pack chosen(PackBits where, Pack a, Pack b) {
#ifdef __AVX2__
    return _mm256_blendv_pd(b, a, reinterpret_cast<Pack>(where));
#else
    return reinterpret_cast<Pack>((reinterpret_cast<PackBits>(a) & where) | (reinterpret_cast<PackBits>(b) & ~where));
#endif
  }
};

}  // namespace OGC_LANES
}  // namespace ogc::reference
