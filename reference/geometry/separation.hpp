// A cheap test before the exact ones: whether two primitives are certainly farther apart than a distance. Two parallel
// planes with nothing between them prove it, in whatever direction they lie, so that only the width of the slab needs
// an error bound.
#pragma once

#include <array>

#include "compare/problem/vector.hpp"

namespace ogc::reference {

/// What a detection must return.
enum class DetectionExtent {
  judged,  ///< all of the stage's truth: pairs counted, near and grey decisions listed
  /// `exact` alone: pairs that can neither be a contact nor lower a smallest distance are left out, also of `pairs`.
  exact
};

/// Returns whether point x[0] and triangle x[1] x[2] x[3] are farther apart than `distance` [m]; false where no slab
/// shows it.
bool surely_beyond_triangle(const std::array<compare::Vec3f, 4>& x, double distance);
/// Returns the same for the edges x[0] x[1] and x[2] x[3].
bool surely_beyond_edge(const std::array<compare::Vec3f, 4>& x, double distance);

}  // namespace ogc::reference
