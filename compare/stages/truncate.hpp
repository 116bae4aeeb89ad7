// Stage truncate: keeps a vertex in its feasible region until the next detection. The region is the ball of its
// conservative bound about X_prev (Eq. 27, Alg. 3 lines 24–27) and, if bounds are planes, its half-spaces (method.md
// §5.6).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compare/problem/vector.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// A half-space n·x ≤ o; n need not be a unit vector.
struct HalfSpace {
  Vec3f normal;       ///< n
  double offset = 0;  ///< o [m] times the length of n
};

/// H of a vertex on which only inertia acts: the identity. The vertex is then projected orthogonally.
inline constexpr std::array<float, 6> inertia_block{1, 0, 0, 1, 0, 1};

/// The half-spaces of each case, and how its vertex slides along them. All arrays are empty if there are no
/// half-spaces.
struct HalfSpacesIn {
  std::vector<Index> offsets;    ///< [cases + 1]: case i has items[offsets[i]] … items[offsets[i + 1] − 1]
  std::vector<HalfSpace> items;  ///< half-spaces of all cases, case by case
  std::vector<Vec3f> current;    ///< current position, in its region [m]
  std::vector<std::array<float, 6>> block;  ///< H: xx, xy, xz, yy, yz, zz [N/m], positive definite
  /// 1: the vertex does not slide, and H is not read. This holds for a prescribed vertex and, with bounds=dat, for any
  /// vertex, which then starts from X_prev
  std::vector<std::uint8_t> is_prescribed;

  /// Returns the half-spaces of case i.
  std::span<const HalfSpace> of(std::size_t i) const {
    if (offsets.empty()) return {};
    const auto first = static_cast<std::size_t>(offsets[i]), last = static_cast<std::size_t>(offsets[i + 1]);
    return std::span(items).subspan(first, last - first);
  }
};

/// Input of the stage: independent vertices. X_prev and the current position lie in the ball. They also lie in each
/// half-space, even after its offset is reduced by 2⁻⁵⁰ (Σ|n_k x_k| + |o|).
struct TruncateIn {
  std::vector<Vec3f> previous, position;  ///< X_prev and x [m]
  std::vector<float> bound;               ///< b_v ≥ 0 [m]
  HalfSpacesIn half_spaces{};             ///< half-spaces of the vertices
};

/// The answer. The *stored* position obeys ‖x − x_prev‖ ≤ b_v and each half-space exactly. A position that obeys all of
/// them is returned bit for bit.
///
/// A vertex that violates two or more half-spaces may end anywhere in its region. A vertex that violates one half-space
/// slides along it to x − H⁻¹n (n·x − o)/(nᵀH⁻¹n), then moves towards X_prev into the ball. It ends there if no other
/// half-space interferes. A prescribed vertex goes along the straight line from its current position to x, as far as
/// the region allows. The end of this path is rounded when it is stored. If this rounding may violate two or more
/// half-spaces that the path does not approach, any point of the path is right.
struct TruncateOut {
  std::vector<Vec3f> position;    ///< x [m]
  std::vector<std::uint8_t> cut;  ///< 1 if x lay outside its region
};

/// The exact answer.
struct TruncateTruth {
  /// `grey`: 1 if both values of `cut` are accepted. No margin then certainly requires a cut, but at least one may: the
  /// ball's margin is in the grey zone, or a half-space's margin is at most `half_space_slack` (Σ|n_k x_k| + |o|)
  std::vector<std::uint8_t> cut, grey;
  std::vector<std::uint8_t> near;  ///< 1 where a margin lies within near_factor
  std::vector<Vec3> position;      ///< exact result, rounded to double
  /// For cases with half-spaces: largest distance of a right answer from `position` [m]; infinite if any answer in the
  /// region is right. Empty if no case has half-spaces.
  std::vector<double> accepted{};
};

/// Relative distance that a kernel may keep from a half-space, because its arithmetic in double makes a few roundings
/// of 2⁻⁵³. Products of single-precision numbers are exact in double; nothing is decided in single precision.
inline constexpr double half_space_slack = 0x1p-48;

/// Largest distance of the stored position from the exact one, in units of u · (‖x_prev‖_∞ + b), u = 2⁻²⁴: storing
/// three coordinates (√3 half ulps), a step towards x_prev if rounding went outwards (the same again), and the relative
/// error of the factor that shortens the move (4 u b).
inline constexpr double truncate_position_tolerance = 8;
/// The tolerance of a stored position for cases with half-spaces. Each of its three coordinates may need another step
/// to the next float (2 u each).
inline constexpr double truncate_region_tolerance = truncate_position_tolerance + 6;
/// Distance that a kernel may keep from a half-space, in units of u Σ|n_k x_k|. Storing can move a position across the
/// half-space by 1, so a kernel aims at a point that lies 1 inside. Storing can then move this point 1 further inside.
inline constexpr double truncate_standoff = 2;
/// Backward error of the solve H⁻¹n in units of u ‖H‖₂, as in a sweep (compare/stages/sweep.hpp).
inline constexpr double truncate_solve_tolerance = 36;

}  // namespace ogc::compare
