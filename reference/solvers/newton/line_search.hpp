// Backtracking along a direction of Newton's method (method.md §7).
#pragma once

#include "reference/solvers/potential.hpp"

namespace ogc::reference {

/// The result of a line search; `share` is 0 if nothing was accepted.
struct Accepted {
  State x;
  double share = 0;
  double change = 0;  ///< change of the energy [J]
};

/// Returns the change of the energy that rounding of the terms' values can cause [J].
double value_noise(const PotentialTerms& terms);

/// Returns the first of `share`, half of it, a quarter … of `delta` that lowers the energy. `before`: the terms at x. A
/// full step may raise the energy by at most `noise` [J], because rounding hides decreases close to the minimum.
Accepted backtracked(const Potential& potential, const State& x, const State& delta, double share,
                     const PotentialTerms& before, double noise);

}  // namespace ogc::reference
