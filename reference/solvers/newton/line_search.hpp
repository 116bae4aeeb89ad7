// Backtracking along a direction of Newton's method (method.md §7).
#pragma once

#include "reference/solvers/potential.hpp"

namespace ogc::reference {

/// What a line search found; nothing where `share` is 0.
struct Accepted {
  State x;
  double share = 0;
  double change = 0;  ///< of the energy [J]
};

/// What rounding of the terms' own values may do to a change of the energy [J].
double value_noise(const PotentialTerms& terms);

/// The first of `share`, half of it, a quarter … of `delta` that lowers the energy; `before`: the terms at x. A full
/// step may also change it by at most `noise` [J]: close to the minimum no decrease can be seen any more.
Accepted backtracked(const Potential& potential, const State& x, const State& delta, double share,
                     const PotentialTerms& before, double noise);

}  // namespace ogc::reference
