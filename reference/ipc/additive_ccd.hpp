// Implements additive continuous collision detection (Li et al. 2021, Algorithm 1) of one pair on a straight motion,
// safely against rounding. Let ℓ be the largest possible approach of the two primitives. The original takes steps of
// 0.9 gap/ℓ until a tenth of the first gap is left. But for needles and parallel edges the formula of the distance can
// be wrong by more than the distance. So the gap here is the width of the empty slab between two parallel planes: for
// any normal it is at most the distance, and its rounding error is known.
//
// A second bound keeps the slab's normal. It is the time until a vertex of one primitive comes within the thickness of
// a vertex of the other primitive along this normal. For pairs that slide past each other this bound is exact, while ℓ
// is far too large. Each step takes the larger bound.
#pragma once

#include "reference/energies/closest_form.hpp"

namespace ogc::reference {

/// The share of the first gap that is left at the returned time (s of Algorithm 1), and the factor of each safe step.
inline constexpr double ccd_gap_left = 0.1, ccd_rescaling = 0.9;

/// Largest number of steps. While a tenth of the first gap g is left, a step is at least 0.09 g/ℓ, where ℓ is the
/// largest possible approach. So the limit ends only motions that would take unreasonably long. The time reached by
/// then is a safe answer.
inline constexpr int ccd_most_steps = 10000;

/// Returns a time t in [0, until], until ≤ 1. On [0, t] the pair stays more than `thickness` [m] apart while its
/// vertices move from x to x + delta. Returns `until` if the pair does not come that near, and 0 if rounding hides the
/// gap at the start. `sides` is point_triangle or edge_edge.
double additive_ccd(compare::ContactSides sides, const std::array<Triple<double>, 4>& x,
                    const std::array<Triple<double>, 4>& delta, double thickness, double until = 1,
                    int most_steps = ccd_most_steps);

}  // namespace ogc::reference
