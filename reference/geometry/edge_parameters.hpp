// The places of contact points on two edges, as parameters from end_0 to end_1, and how much they react to the
// coordinates.
#pragma once

#include <array>

#include "reference/geometry/closest_points.hpp"

namespace ogc::reference {

/// One pair of contact points, by its parameters.
struct EdgeParameters {
  std::array<double, 2> values{};  ///< in [0, 1]
  /// The larger Σ|∂s/∂δᵢ||δᵢ| of the two, δ relative to the first edge's end_0; at least 1, infinite where undefined.
  double condition = 1;
  double distance = 0;  ///< of the two points [m]; set by parallel_parameters only
};

/// Returns the parameters of the closest points, whose features are given.
EdgeParameters closest_parameters(const EdgePair& pair, EdgeFeatures features);

/// Returns the parameters for nearly parallel edges: the middle of the overlap on the first edge, and its projection on
/// the closed second edge. They are computed in long double: every quotient has a denominator of the size of its terms,
/// so nothing cancels.
EdgeParameters parallel_parameters(const EdgePair& pair);

}  // namespace ogc::reference
