// What the verdicts of all stages share: errors in units, numbers in messages.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

#include "compare/problem/vector.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// 0 where the error is 0, whatever the scale; otherwise the error in units of u · scale. What is below the smallest
/// normal number 2⁻¹²⁶ is rounded to a multiple of 2⁻¹⁴⁹: no kernel can avoid an error of u · 2⁻¹²⁶ there.
inline double in_units(double error, double scale) {
  return error == 0 ? 0 : error / (unit_roundoff * (scale + 0x1p-126));
}

/// Whether each coordinate is a number, and not infinite.
inline bool is_finite(const Vec3f& x) { return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z); }

/// Two numbers by a printf format.
inline std::string text(const char* format, double a, double b) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

}  // namespace ogc::compare
