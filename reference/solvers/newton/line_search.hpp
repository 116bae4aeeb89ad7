// Backtracking along a direction of Newton's method (method.md §7).
#pragma once

#include "reference/solvers/potential.hpp"

namespace ogc::reference {

/// The result of a line search; a `share` of 0 means that nothing was accepted.
struct Accepted {
  State x;
  double share = 0;
  double change = 0;  ///< change of the energy [J]
};

/// Returns by how much rounding of the terms' own values may change the energy [J].
double value_noise(const PotentialTerms& terms);

/// Returns the first of `share`, half of it, a quarter … of `delta` that lowers the energy. `before`: the terms at x. A
/// full step may also raise the energy by at most `noise` [J]: close to the minimum no decrease can be seen any more.
Accepted backtracked(const Potential& potential, const State& x, const State& delta, double share,
                     const PotentialTerms& before, double noise);

}  // namespace ogc::reference
