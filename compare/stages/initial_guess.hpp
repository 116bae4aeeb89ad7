// Stage initial_guess: one round of the guess loop for one vertex, which computes y and x ← y truncated about X_prev
// (Eq. 27, 28; method.md §5.2); and the frame of one segment of a rod, rotated with the segment (compare/rods.md).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compare/problem/vector.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// Coordinates of xᵗ, X_prev, vᵗ and a are at most 2²⁰ in modulus and may be arbitrarily small. h is within 2⁻²⁰ … 1,
/// b_v at most 2⁴⁰. So nothing overflows.
struct InitialGuessCase {
  Vec3f start, velocity, acceleration;  ///< xᵗ [m], vᵗ [m/s], a_ext [m/s²]
  float time_step = 0;                  ///< h [s]
  Vec3f previous;                       ///< X_prev [m], which is also x
  float bound = 0;                      ///< b_v [m]
  std::uint8_t reserved = 0;            ///< 0: an unused byte of the plug-ins' structure
};

/// A segment with its frame. D and Dᵗ are 0 or 2⁻⁵⁰ m … 2⁴⁰ m long; qᵗ is a unit quaternion within
/// unit_quaternion_slack. The answer is qᵗ rotated by the smallest rotation from Dᵗ to D. If D and Dᵗ are opposite, it
/// is qᵗ i, a rotation by π about the frame's first axis. If D or Dᵗ is 0, it is qᵗ.
struct TurnCase {
  Vec3f before, now;                   ///< Dᵗ, D [m]
  Quaternion orientation{0, 0, 0, 1};  ///< qᵗ
};

/// Input of the stage.
struct InitialGuessIn {
  std::vector<InitialGuessCase> cases;  ///< independent of each other
  std::vector<TurnCase> turns{};        ///< independent of each other
};

/// The answer. The stored position obeys ‖x − x_prev‖ ≤ b_v exactly.
struct InitialGuessOut {
  std::vector<Vec3f> target, position;    ///< y, x [m]
  std::vector<std::uint8_t> cut;          ///< 1 if the stored y has ‖y − x_prev‖ > b_v
  std::vector<Quaternion> orientation{};  ///< one for each element of `turns`
};

/// The exact y and frames, with their error scales. The judge checks `position` and `cut` against the truth of stage
/// truncate for the answer's y.
struct InitialGuessTruth {
  std::vector<Vec3> target;                          ///< exact y [m]
  std::vector<double> target_scale;                  ///< largest |xᵗ| + h |vᵗ| + h² |a| of a coordinate [m]
  std::vector<std::array<double, 4>> orientation{};  ///< exact t qᵗ; t is the smallest rotation, real part ≥ 0
  /// 1/cos(θ/2), where θ is the angle between Dᵗ and D: the factor by which an error of these directions grows.
  /// Infinite if the tolerance allows an error of half a radian or more; then any unit quaternion is accepted
  std::vector<double> orientation_scale{};
};

/// Largest error of y's coordinates in units of u · target_scale, u = 2⁻²⁴. The term h² a is rounded four times (h a,
/// the sum with vᵗ, the product with h, the sum with xᵗ), h vᵗ three times, xᵗ once.
inline constexpr double initial_guess_target_tolerance = 4;
/// Largest error of a rotated frame in units of u · orientation_scale. Let a and b be the directions of Dᵗ and D. Their
/// lengths have errors of 5 u each (a scalar product, a root, a quotient), their components 1 u. The error of the
/// quaternion (a × b, 1 + a·b) is 16 u: 10 u from both lengths, 2 u from the cross product, 4 u from the scalar product
/// and the sum. Normalisation divides it by the quaternion's length 2 cos(θ/2), which leaves 8 u · orientation_scale.
/// The product with qᵗ adds 8, and two normalisations 4 each.
inline constexpr double initial_guess_turn_tolerance = 24;

}  // namespace ogc::compare
