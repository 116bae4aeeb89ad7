// How near is a state to touching? The exact smallest distances, for audits and for the figure that shows them.
#pragma once

#include <limits>
#include <span>

#include "compare/problem/exclusions.hpp"

namespace ogc::compare {

/// Smallest distances over pairs that share no vertex and do not lie inside one rigid group, without isolated vertices
/// [m]; infinite, with -1, where there is no pair.
struct SmallestDistances {
  double vertex_triangle = std::numeric_limits<double>::infinity();  ///< [m]
  Index vertex = -1, triangle = -1;                                  ///< the pair; −1 where there is none
  double edge_edge = std::numeric_limits<double>::infinity();        ///< [m]
  Index edge = -1, other_edge = -1;                                  ///< edge < other_edge
};

/// Which pairs are nearest is decided exactly; of pairs equally near the one with the smallest numbers is named. The
/// distances are the exact ones rounded down. `exclusions`: pairs that are left out beside adjacent ones. Throws
/// InputError for positions that are not finite.
SmallestDistances smallest_distances(const Topology& topology, std::span<const Vec3> positions,
                                     const ExclusionView& exclusions = {});

}  // namespace ogc::compare
