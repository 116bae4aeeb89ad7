// Additive continuous collision detection (Li et al. 2021, Algorithm 1) of one pair on a straight motion, made safe
// against rounding. The original steps by 0.9 gap/ℓ, with ℓ the fastest that the two primitives can approach each
// other, until a tenth of the first gap is left. Here the gap is not the distance, whose formula can be wrong by more
// than the distance itself for needles and parallel edges, but the width of the empty slab between two parallel planes:
// for any normal it is at most the distance, and its rounding error is known. The same slab, held fixed, gives a second
// bound: it is empty until a vertex of one side meets one of the other. This bound is exact for pairs that slide past
// each other, for which ℓ is far too large. The larger bound is taken.
#pragma once

#include "reference/energies/closest_form.hpp"

namespace ogc::reference {

/// The share of the first gap that is left at the returned time (s of Algorithm 1), and the factor that shortens each
/// safe step.
inline constexpr double ccd_gap_left = 0.1, ccd_rescaling = 0.9;

/// Each safe step takes at least a ninetieth part of what ℓ allows for a tenth of the gap, so this limit ends only
/// motions that would take unreasonably long; the time reached by then is a safe answer.
inline constexpr int ccd_most_steps = 10000;

/// Returns a time t in [0, until] such that on [0, t] the pair keeps more than `thickness` [m] apart while its vertices
/// move from x to x + delta; `until` where nothing is in the way. Returns 0 where no gap can be told from rounding at
/// the start. Sides are point_triangle or edge_edge; until ≤ 1.
double additive_ccd(compare::ContactSides sides, const std::array<Triple<double>, 4>& x,
                    const std::array<Triple<double>, 4>& delta, double thickness, double until = 1,
                    int most_steps = ccd_most_steps);

}  // namespace ogc::reference
