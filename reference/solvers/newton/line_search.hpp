// Backtracking along a direction of Newton's method (method.md §7).
#pragma once

#include "reference/solvers/potential.hpp"

namespace ogc::reference {

/// The result of a line search; `share` is the accepted share of the direction, 0 if no share was accepted.
struct Accepted {
  State x;
  double share = 0;
  double change = 0;  ///< change of the energy [J]
};

/// Returns the change of the energy that rounding of the terms' values can cause [J].
double value_noise(const PotentialTerms& terms);

/// Tries the shares `share`, `share`/2, `share`/4, … of `delta` and returns the first that lowers the energy. `before`
/// holds the terms at x. The first share may also raise the energy by up to `noise` [J], because rounding hides
/// decreases close to the minimum.
Accepted backtracked(const Potential& potential, const State& x, const State& delta, double share,
                     const PotentialTerms& before, double noise);

}  // namespace ogc::reference
