// Helps the verdicts of all stages: computes errors in units and prints numbers in messages.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

#include "compare/problem/vector.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// Returns the error in units of 2⁻²⁴ · scale; 0 if the error is 0. The unit is at least 2⁻²⁴ · 2⁻¹²⁶, because numbers
/// below 2⁻¹²⁶ are rounded to multiples of 2⁻¹⁴⁹.
inline double in_units(double error, double scale) {
  return error == 0 ? 0 : error / (unit_roundoff * (scale + 0x1p-126));
}

/// Checks whether each coordinate is a finite number.
inline bool is_finite(const Vec3f& x) { return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z); }

/// Prints two numbers by a printf format.
inline std::string text(const char* format, double a, double b) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

}  // namespace ogc::compare
