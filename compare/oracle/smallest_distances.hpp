// Finds how near a state is to touching: the exact smallest distances, for audits and figures.
#pragma once

#include <limits>
#include <span>

#include "compare/problem/exclusions.hpp"

namespace ogc::compare {

/// Holds the smallest distances [m] over pairs that share no vertex and are not excluded. If there is no pair, the
/// distance is infinite and the indices are −1. Isolated vertices are left out.
struct SmallestDistances {
  double vertex_triangle = std::numeric_limits<double>::infinity();  ///< [m]
  Index vertex = -1, triangle = -1;                                  ///< the pair; −1 if there is none
  double edge_edge = std::numeric_limits<double>::infinity();        ///< [m]
  Index edge = -1, other_edge = -1;                                  ///< edge < other_edge
};

/// Returns the smallest distances, rounded down. The nearest pairs are found exactly; of equally near pairs the pair
/// with the smallest indices is returned. Adjacent and excluded pairs are left out. Throws InputError for positions
/// that are not finite.
SmallestDistances smallest_distances(const Topology& topology, std::span<const Vec3> positions,
                                     const ExclusionView& exclusions = {});

}  // namespace ogc::compare
