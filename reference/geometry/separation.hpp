// A cheap question before the exact ones: are two primitives certainly farther apart than this? Two parallel planes
// with nothing between them prove it, in whatever direction they were drawn, so that only the width of the slab needs
// an error bound.
#pragma once

#include <array>

#include "compare/problem/vector.hpp"

namespace ogc::reference {

/// What a detection is asked for.
enum class DetectionExtent {
  judged,  ///< all of the stage's truth: pairs counted, near and grey decisions listed
  /// `exact` alone: a pair that can be neither a contact nor lower a smallest distance is left out, and out of `pairs`,
  /// too
  exact
};

/// Whether point x[0] and triangle x[1] x[2] x[3] are farther apart than `distance` [m]; false where no slab shows it.
bool surely_beyond_triangle(const std::array<compare::Vec3f, 4>& x, double distance);
/// Whether the edges x[0] x[1] and x[2] x[3] are farther apart likewise.
bool surely_beyond_edge(const std::array<compare::Vec3f, 4>& x, double distance);

}  // namespace ogc::reference
