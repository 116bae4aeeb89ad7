// Draws random numbers by counter: the n-th number of a case is a hash of (stage, generator, seed, index, n). So a case
// depends neither on earlier cases nor on the number of threads, and its problem string reproduces it. Device code
// gives the same bits for all numbers except `magnitude` (a library's power) and `between` (contraction);
// tests/fast/cuda/random.cu checks this.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>

namespace ogc::compare {

/// Draws the random numbers of one case. The key contains the names of stage and generator, not their indices, so that
/// a new stage or generator changes no other case.
class Random {
 public:
  constexpr Random(std::string_view stage, std::string_view generator, std::uint64_t seed, std::uint64_t index)
      : key_(mix(mix(mix(mix(seed) + hash(stage)) + hash(generator)) + index)) {}

  /// Returns 64 uniform bits.
  constexpr std::uint64_t bits() { return mix(key_ + 0x9e3779b97f4a7c15u * ++counter_); }
  /// Returns a multiple of 2⁻⁵³ in [0, 1).
  constexpr double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  constexpr double between(double low, double high) { return low + (high - low) * unit(); }
  /// Returns an integer in [0, n), n ≥ 1; the bias of n/2⁶⁴ does not matter here.
  constexpr int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
  /// Returns true in one of n draws.
  constexpr bool one_in(int n) { return below(n) == 0; }
  constexpr double sign() { return one_in(2) ? 1 : -1; }
  template <class T>
  constexpr T pick(std::span<const T> items) {
    return items[bits() % items.size()];
  }
  /// Returns 10^x for x uniform in [low, high).
  double magnitude(double low, double high) { return std::pow(10.0, between(low, high)); }
  /// Returns a positive single-precision number whose bit pattern is uniform over 2⁻²⁰ … 2²⁰.
  constexpr float pattern() { return pattern(0x1p-20f, 0x1p20f); }
  /// Returns a number whose bit pattern is uniform over low … high, both positive.
  constexpr float pattern(float low, float high) {
    const std::uint32_t first = std::bit_cast<std::uint32_t>(low), last = std::bit_cast<std::uint32_t>(high);
    return std::bit_cast<float>(first + static_cast<std::uint32_t>(bits() % (last - first + 1)));
  }
  /// Returns x with its last `count` bits replaced.
  constexpr float last_bits(float x, int count) {
    const std::uint32_t kept = ~0u << count;
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(x) & kept) |
                                (static_cast<std::uint32_t>(bits()) & ~kept));
  }
  /// Returns a rung of a ladder towards a degeneracy: 0 in one of four draws, otherwise ±10⁻ᵏ with k = 1 … 12.
  constexpr double rung() {
    constexpr double powers[]{1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
    if (one_in(4)) return 0;
    const double direction = sign();
    return direction * powers[fine_ ? 4 + below(8) : below(12)];
  }
  /// Makes all further rungs 0 or ±10⁻⁵ … ±10⁻¹², for a fine case, next to a decision boundary.
  constexpr void be_fine() { fine_ = true; }
  constexpr bool is_fine() const { return fine_; }

 private:
  static constexpr std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }
  static constexpr std::uint64_t hash(std::string_view name) {
    std::uint64_t h = 0xcbf29ce484222325u;
    for (const char c : name) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return h;
  }
  std::uint64_t key_, counter_ = 0;
  bool fine_ = false;
};

}  // namespace ogc::compare
