// What the verdicts of all stages share: errors in units, numbers in messages.
#pragma once

#include <cstdio>
#include <string>

#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// 0 where the error is 0, whatever the scale; otherwise the error in units of u · scale.
inline double in_units(double error, double scale) { return error == 0 ? 0 : error / (unit_roundoff * scale); }

/// Two numbers by a printf format.
inline std::string text(const char* format, double a, double b) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

}  // namespace ogc::compare
