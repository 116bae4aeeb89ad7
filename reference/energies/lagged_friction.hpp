// IPC's lagged friction potential f₀ as a function of the slip length y, in Input numbers (method.md §4.4), for
// contacts of all kinds. f₀ is the integral of f₁. Its derivative by the squared slip, f₁(y)/(2 y), has a separate
// formula that is finite at zero slip.
#pragma once

#include "reference/energies/inputs.hpp"

namespace ogc::reference {

/// Returns the length ‖u‖ of a slip u. The error of u is `units` · 2⁻²⁴ times its condition. If u may be 0 within this
/// error, its direction is unknown, and each derivative of ‖u‖ is set to the length of the derivative of u.
inline Input slip_length(const Inputs& inputs, const Triple<Input>& slip, double units) {
  Input y = sqrt(dot(slip, slip));
  if (y.value > units * compare::unit_roundoff * inputs.condition(slip)) return y;
  y.count = y.slope.size();
  for (std::size_t i = 0; i < y.count; ++i)
    y.slope[i] = std::hypot(slip[0].slope[i], slip[1].slope[i], slip[2].slope[i]);
  return y;
}

/// Returns f₁(y)/y.
inline Input slope_over_slip(const Input& y, const Input& limit) {
  return y.value < limit.value ? (Input(2.0) - y / limit) / limit : Input(1.0) / y;
}

/// Returns f₀(y).
inline Input lagged_potential(const Input& y, const Input& limit) {
  if (!(y.value < limit.value)) return y;
  return y * y / limit - y * y * y / (Input(3.0) * limit * limit) + limit / Input(3.0);
}

}  // namespace ogc::reference
