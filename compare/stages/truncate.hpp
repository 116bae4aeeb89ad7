// Stage truncate: a vertex's position kept within its conservative bound about X_prev (Eq. 27, Alg. 3 lines 24–27).
#pragma once

#include <cstdint>
#include <vector>

#include "compare/problem/vector.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// The question: vertices that have nothing to do with each other.
struct TruncateIn {
  std::vector<Vec3f> previous, position;  ///< X_prev and x [m]
  std::vector<float> bound;               ///< b_v ≥ 0 [m]
};

/// The position that is *stored* obeys ‖x − x_prev‖ ≤ b_v exactly. A position that obeys comes back bit for bit.
struct TruncateOut {
  std::vector<Vec3f> position;    ///< x [m]
  std::vector<std::uint8_t> cut;  ///< 1 where ‖x − x_prev‖ > b_v
};

/// The exact answer.
struct TruncateTruth {
  std::vector<std::uint8_t> cut, grey;  ///< grey: the exact margin lies in the grey zone, either flag is accepted
  std::vector<std::uint8_t> near;       ///< 1 where the margin lies within near_factor
  std::vector<Vec3> position;           ///< exact result, rounded to double
};

/// Largest distance of the stored position from the exact one, in units of u · (‖x_prev‖_∞ + b): storing three
/// coordinates (√3 half ulps), a step towards x_prev where rounding went outwards (as much again), and the relative
/// error of the scale (4 u b).
inline constexpr double truncate_position_tolerance = 8;

}  // namespace ogc::compare
