// Tests cheaply, before exact tests, whether two primitives are certainly farther apart than a distance. Two parallel
// planes with one primitive on either side prove it, for any direction of the planes. So only the width of the slab
// between them needs an error bound.
#pragma once

#include <array>

#include "compare/problem/vector.hpp"

namespace ogc::reference {

/// Selects what a detection returns.
enum class DetectionExtent {
  judged,  ///< the whole truth of the stage: counts pairs, lists near and grey decisions
  /// only `exact`: skips pairs that can neither be a contact nor lower a smallest distance, and does not count them
  exact
};

/// Returns whether point x[0] and triangle x[1] x[2] x[3] are certainly farther apart than `distance` [m]; false if no
/// slab was found.
bool surely_beyond_triangle(const std::array<compare::Vec3f, 4>& x, double distance);
/// Returns whether the edges x[0] x[1] and x[2] x[3] are certainly farther apart than `distance` [m]; false if no slab
/// was found.
bool surely_beyond_edge(const std::array<compare::Vec3f, 4>& x, double distance);

}  // namespace ogc::reference
