// atan2 of our own, because library versions differ between host and device and an angle feeds positions (design.md §3).
#pragma once

#include <cmath>

#include "fast/kernels/qualifiers.hpp"

namespace ogc::fast {

/// Angle of (x, y) in [−π, π]; 0 where both are 0. Relative error at most 4 u (tests/fast/kernels/arctangent.cpp): the polynomial, a minimax fit of
/// (atan t − t)/t³ in t² on |t| ≤ tan(π/8), is off by 0.02 u; the rest is one division, one or two sums and the rounded π/4, π/2 or π.
OGC_HD inline float arctangent2(float y, float x) {
  constexpr float tan_eighth = 0.41421357f, quarter = 0.78539819f, half = 1.57079637f, whole = 3.14159274f;
  const float ax = fabsf(x), ay = fabsf(y);
  const float larger = ax > ay ? ax : ay, smaller = ax > ay ? ay : ax;
  if (!(larger > 0)) return 0.0f;
  const bool shifted = smaller > tan_eighth * larger;
  const float t = shifted ? (smaller - larger) / (smaller + larger) : smaller / larger;
  const float z = t * t;
  const float p = -0.33333316f + z * (0.19998471f + z * (-0.14243522f + z * (0.10593727f + z * -0.060779907f)));
  float angle = t + t * (z * p);
  if (shifted) angle = quarter + angle;
  if (ay > ax) angle = half - angle;
  if (x < 0) angle = whole - angle;
  return y < 0 ? -angle : angle;
}

}  // namespace ogc::fast
