// Computes where contact points lie on two edges, as parameters from end_0 to end_1, and how sensitive these parameters
// are to the coordinates.
#pragma once

#include <array>

#include "reference/geometry/closest_points.hpp"

namespace ogc::reference {

/// The parameters of one pair of contact points.
struct EdgeParameters {
  std::array<double, 2> values{};  ///< in [0, 1]
  /// For each parameter s the sum Σ|∂s/∂δᵢ||δᵢ|, where δ are the coordinates relative to the first edge's end_0.
  /// `condition` is the larger sum, at least 1; infinite if a parameter is undefined.
  double condition = 1;
  double distance = 0;  ///< distance of the two points [m]; set by parallel_parameters only
};

/// Returns the parameters of the closest points; `features` are the features that hold them.
EdgeParameters closest_parameters(const EdgePair& pair, EdgeFeatures features);

/// Returns the parameters for nearly parallel edges: the middle of the overlap on the first edge, and the projection of
/// this middle on the closed second edge. Computes in long double; none of the quotients suffers cancellation.
EdgeParameters parallel_parameters(const EdgePair& pair);

}  // namespace ogc::reference
