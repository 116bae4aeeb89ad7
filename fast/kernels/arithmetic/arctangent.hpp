// Computes atan2 without a library: library versions differ between host and device, and positions depend on the angle
// (method.md §7.5).
#pragma once

#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/scalar.hpp"

namespace ogc::fast {

/// Returns the angle of (x, y) in [−π, π]; 0 if both are 0. With u = 2⁻²⁴ the relative error is at most 4 u
/// (tests/fast/kernels/arithmetic/arctangent.cpp). The polynomial is a minimax fit of (atan t − t)/t³ in t² on |t| ≤
/// tan(π/8), with an error of 0.02 u. The remaining error comes from one division, one or two sums, and the rounded
/// constants π/4, π/2 and π.
template <class T>
OGC_HD T arctangent2(const T& y, const T& x) {
  constexpr float tan_eighth = 0.41421357f, quarter = 0.78539819f, half = 1.57079637f, whole = 3.14159274f;
  const T ax = absolute(x), ay = absolute(y);
  const T larger = select(ax > ay, ax, ay), smaller = select(ax > ay, ay, ax);
  const Mask<T> somewhere = larger > T{}, shifted = smaller > tan_eighth * larger;
  if (is_false(somewhere)) return T{};
  const T t = select(shifted, smaller - larger, smaller) / select(shifted, smaller + larger, larger);
  const T z = t * t;
  const T p = -0.33333316f + z * (0.19998471f + z * (-0.14243522f + z * (0.10593727f + z * -0.060779907f)));
  T angle = t + t * (z * p);
  angle = select(shifted, quarter + angle, angle);
  angle = select(ay > ax, half - angle, angle);
  angle = select(x < T{}, whole - angle, angle);
  return select(somewhere, select(y < T{}, -angle, angle), T{});
}

}  // namespace ogc::fast
