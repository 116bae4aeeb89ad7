// Helps verdicts and wrong forms of closest_face and closest_points. Σ|δ| (method.md §2.5) sums the moduli of all
// coordinates relative to the case's first vertex.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>

#include "compare/judge/engine/tally.hpp"
#include "compare/judge/engine/units.hpp"
#include "compare/stages/closest_face.hpp"

namespace ogc::compare {

/// Returns the sum of the moduli of p's coordinates relative to `from`.
inline double modulus(const Vec3f& p, const Vec3f& from) {
  return std::abs(double{p.x} - from.x) + std::abs(double{p.y} - from.y) + std::abs(double{p.z} - from.z);
}

/// Checks whether each array of an answer has one entry for each case; reports a mismatch if not.
inline bool right_lengths(std::size_t n, std::initializer_list<std::size_t> lengths, Tally& tally) {
  for (const std::size_t length : lengths) {
    if (length == n) continue;
    tally.mismatch("an array of the answer has " + std::to_string(length) + " entries for " + std::to_string(n) +
                   " cases");
    return false;
  }
  return true;
}

/// Judges a lower bound of a distance. Returns false if `below` is NaN or above the exact distance.
inline bool judge_below(float below, float exact, double distance, double scale, std::size_t metric, Tally& tally) {
  if (!(below <= exact)) {
    tally.mismatch(text("distance_below: %.9g is above the exact distance %.17g", below, distance));
    return false;
  }
  tally.error(metric, in_units(double{exact} - below, scale),
              [&] { return text("%.9g, exact %.17g", below, distance); });
  return true;
}

/// Checks whether several answers are accepted, that is, whether several bits are set.
inline bool is_grey(std::uint32_t accepted) { return (accepted & (accepted - 1)) != 0; }

/// Absolute thresholds that are common in programs. Forms that compare a length use the first `length_thresholds`;
/// forms that compare a square or a product use all. Shorter lengths are smaller than every tolerance of these stages.
inline constexpr std::size_t length_thresholds = 7;
inline constexpr std::array<std::pair<const char*, double>, 10> thresholds{{{"1e-3", 1e-3},
                                                                            {"1e-4", 1e-4},
                                                                            {"1e-5", 1e-5},
                                                                            {"1e-6", 1e-6},
                                                                            {"1e-7", 1e-7},
                                                                            {"1e-8", 1e-8},
                                                                            {"1e-9", 1e-9},
                                                                            {"1e-10", 1e-10},
                                                                            {"1e-11", 1e-11},
                                                                            {"1e-12", 1e-12}}};

/// Returns a − b without rounding.
inline Vec3 difference(const Vec3f& a, const Vec3f& b) {
  return {double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z};
}

/// Returns a number just above all distances that the tolerance accepts in place of `distance`.
inline float surely_above(double distance, double size) {
  const double above = distance + closest_face_distance_tolerance * unit_roundoff * std::max(distance, size);
  return std::nextafter(static_cast<float>(above), std::numeric_limits<float>::infinity());
}

}  // namespace ogc::compare
