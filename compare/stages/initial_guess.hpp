// Stage initial_guess: y of one vertex, and x ← y truncated about X_prev: one round of the guess loop (Eq. 27, 28;
// method.md §5.2).
#pragma once

#include <cstdint>
#include <vector>

#include "compare/problem/vector.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// Coordinates of xᵗ, X_prev, vᵗ and a are at most 2²⁰ in modulus, however small, h is within 2⁻²⁰ … 1, b_v up to 2⁴⁰:
/// nothing overflows.
struct InitialGuessCase {
  Vec3f start, velocity, acceleration;  ///< xᵗ [m], vᵗ [m/s], a_ext [m/s²]
  float time_step = 0;                  ///< h [s]
  Vec3f previous;                       ///< X_prev [m]; where x is, too
  float bound = 0;                      ///< b_v [m]
  /// 1: from round 2 on and part of an active contact: stays where it is, and does not count as cut
  std::uint8_t held = 0;
};

/// The question: cases that have nothing to do with each other.
struct InitialGuessIn {
  std::vector<InitialGuessCase> cases;  ///< each by itself
};

/// The position that is stored obeys ‖x − x_prev‖ ≤ b_v exactly.
struct InitialGuessOut {
  std::vector<Vec3f> target, position;  ///< y, x [m]
  std::vector<std::uint8_t> cut;        ///< 1 where ‖y − x_prev‖ > b_v, for the y that is stored
};

/// Exact y with the sum of the moduli of its terms in each coordinate. Position and cut are those of the *given* y
/// (stage truncate): the judge asks for them.
struct InitialGuessTruth {
  std::vector<Vec3> target;          ///< exact y [m]
  std::vector<double> target_scale;  ///< largest over the coordinates of |xᵗ| + h |vᵗ| + h² |a| [m]
};

/// Largest error of y's coordinates in units of u · target_scale: h a passes four roundings (with h, with vᵗ, with h,
/// with xᵗ), vᵗ three, xᵗ one.
inline constexpr double initial_guess_target_tolerance = 4;

}  // namespace ogc::compare
