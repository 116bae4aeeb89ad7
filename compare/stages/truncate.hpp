// Stage truncate: keeps a vertex's position in its feasible region until the next detection: the ball of its
// conservative bound about X_prev (Eq. 27, Alg. 3 lines 24–27), and half-spaces where bounds are planes (method.md
// §5.6).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compare/problem/vector.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// n·x ≤ o; n need not be a unit vector.
struct HalfSpace {
  Vec3f normal;       ///< n
  double offset = 0;  ///< o [m] times the length of n
};

/// H of a vertex without forces but inertia: it slides by the shortest way.
inline constexpr std::array<float, 6> inertia_block{1, 0, 0, 1, 0, 1};

/// Half-spaces, and how a vertex slides along them. All arrays are empty if no case has any.
struct HalfSpacesIn {
  std::vector<Index> offsets;  ///< [cases + 1]: case i has items[offsets[i]] … items[offsets[i + 1] − 1]
  std::vector<HalfSpace> items;
  std::vector<Vec3f> current;               ///< current position, in its region [m]
  std::vector<std::array<float, 6>> block;  ///< H: xx, xy, xz, yy, yz, zz [N/m], positive definite
  /// 1: the vertex does not slide, and H is not read: a prescribed vertex, or, with bounds=dat, any vertex, from X_prev
  std::vector<std::uint8_t> is_prescribed;

  /// Returns the half-spaces of case i.
  std::span<const HalfSpace> of(std::size_t i) const {
    if (offsets.empty()) return {};
    const auto first = static_cast<std::size_t>(offsets[i]), last = static_cast<std::size_t>(offsets[i + 1]);
    return std::span(items).subspan(first, last - first);
  }
};

/// The question: independent vertices. X_prev and the current position keep each half-space with 2⁻⁵⁰ (Σ|n_k x_k| +
/// |o|) to spare, and the ball.
struct TruncateIn {
  std::vector<Vec3f> previous, position;  ///< X_prev and x [m]
  std::vector<float> bound;               ///< b_v ≥ 0 [m]
  HalfSpacesIn half_spaces{};
};

/// The position that is *stored* obeys ‖x − x_prev‖ ≤ b_v and each half-space exactly. A position that obeys all of
/// them comes back bit for bit.
///
/// A vertex that violates two or more half-spaces has to satisfy only that. One that violates a single one slides along
/// it, x − H⁻¹n (n·x − o)/(nᵀH⁻¹n), then goes into the ball, towards X_prev; if no other half-space interferes, this is
/// its position. A prescribed vertex goes as far along the straight way from its current position to x as the region
/// allows; if two half-spaces lie along that way, nearer than storing moves a position, any point on it is right.
struct TruncateOut {
  std::vector<Vec3f> position;    ///< x [m]
  std::vector<std::uint8_t> cut;  ///< 1 where x lay outside its region
};

/// The exact answer.
struct TruncateTruth {
  /// grey: the exact margin of the ball lies in the grey zone, or that of a half-space is at most `half_space_slack`
  /// (Σ|n_k x_k| + |o|), and nothing else decides: either flag is accepted
  std::vector<std::uint8_t> cut, grey;
  std::vector<std::uint8_t> near;  ///< 1 where a margin lies within near_factor
  std::vector<Vec3> position;      ///< exact result, rounded to double
  /// For cases with half-spaces: largest distance of a right answer from `position` [m]; infinite where the answer is
  /// free. Empty if no case has any.
  std::vector<double> accepted{};
};

/// A kernel may keep this share away from a half-space, for its own arithmetic in double: a few roundings of 2⁻⁵³.
/// Products of single-precision numbers are exact there; nothing is decided in single precision.
inline constexpr double half_space_slack = 0x1p-48;

/// Largest distance of the stored position from the exact one, in units of u · (‖x_prev‖_∞ + b): storing three
/// coordinates (√3 half ulps), a step towards x_prev where rounding went outwards (as much again), and the relative
/// error of the scale (4 u b).
inline constexpr double truncate_position_tolerance = 8;
/// The same with half-spaces: a step may be needed in each of three coordinates (2 u each).
inline constexpr double truncate_region_tolerance = truncate_position_tolerance + 6;
/// A kernel may stop this far short of a half-space, in units of u Σ|n_k x_k|, since storing can move a position across
/// it: one for storing, twice, since the ball can bring it back; rounded up to a power of two.
inline constexpr double truncate_standoff = 4;
/// Backward error of the solve H⁻¹n in units of u ‖H‖₂, as in a sweep (compare/stages/sweep.hpp).
inline constexpr double truncate_solve_tolerance = 36;

}  // namespace ogc::compare
