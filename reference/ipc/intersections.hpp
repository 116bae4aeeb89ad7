// Finds edges that meet triangles at a state, as a check of the continuous detection. Predicates are exact (filtered)
// on the given doubles.
#pragma once

#include "reference/ipc/pairs.hpp"

namespace ogc::reference {

/// An edge that meets a triangle without sharing a vertex with it.
struct EdgeThroughTriangle {
  compare::Index edge = -1, triangle = -1;
  friend auto operator<=>(const EdgeThroughTriangle&, const EdgeThroughTriangle&) = default;
};
/// Returns text such as "edge (vertices 3, 7) and triangle 40 (vertices 1, 2, 5)".
std::string describe(const compare::Topology& topology, const EdgeThroughTriangle& meeting,
                     const compare::ElementNames& names = {});

/// Returns all intersections, ascending; touching counts. Pairs that share a vertex or are excluded (PairMesh) are left
/// out.
std::vector<EdgeThroughTriangle> intersections(const PairMesh& mesh, const State& x);

}  // namespace ogc::reference
