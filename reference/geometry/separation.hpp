// A cheap test before the exact ones: whether two primitives are certainly farther apart than a distance. Two parallel
// planes with nothing between them prove it for any direction of the planes, so only the width of the slab needs an
// error bound.
#pragma once

#include <array>

#include "compare/problem/vector.hpp"

namespace ogc::reference {

/// Selects what a detection returns.
enum class DetectionExtent {
  judged,  ///< the whole truth of the stage: pairs counted, near and grey decisions listed
  /// only `exact`: pairs that can neither be a contact nor lower a smallest distance are skipped and not counted
  exact
};

/// Returns whether point x[0] and triangle x[1] x[2] x[3] are certainly farther apart than `distance` [m]; false if no
/// slab proves it.
bool surely_beyond_triangle(const std::array<compare::Vec3f, 4>& x, double distance);
/// Returns the same for the edges x[0] x[1] and x[2] x[3].
bool surely_beyond_edge(const std::array<compare::Vec3f, 4>& x, double distance);

}  // namespace ogc::reference
