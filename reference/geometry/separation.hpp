// Tests cheaply, before exact tests, whether two primitives are certainly farther apart than a distance. Any slab
// between the primitives proves a distance: two parallel planes with the first primitive on one side and the second on
// the other. So only the width of this slab needs an error bound.
#pragma once

#include <array>

#include "compare/problem/vector.hpp"

namespace ogc::reference {

/// Selects what a detection returns.
enum class DetectionExtent {
  judged,  ///< the whole truth of the stage: counts pairs, lists near and grey decisions
  /// only `exact` of the truth: skips a pair without counting it if the pair can be no contact and lower no smallest
  /// distance
  exact
};

/// Returns whether point x[0] and triangle x[1] x[2] x[3] are certainly farther apart than `distance` [m]; false if no
/// slab was found.
bool surely_beyond_triangle(const std::array<compare::Vec3f, 4>& x, double distance);
/// Returns whether the edges x[0] x[1] and x[2] x[3] are certainly farther apart than `distance` [m]; false if no slab
/// was found.
bool surely_beyond_edge(const std::array<compare::Vec3f, 4>& x, double distance);

}  // namespace ogc::reference
