// The guard behind the continuous detection: does any edge meet a triangle at this very state? Predicates are exact
// (filtered), the doubles are taken as they are.
#pragma once

#include "reference/ipc/pairs.hpp"

namespace ogc::reference {

/// An edge that meets a triangle without sharing a vertex with it.
struct EdgeThroughTriangle {
  compare::Index edge = -1, triangle = -1;
  friend auto operator<=>(const EdgeThroughTriangle&, const EdgeThroughTriangle&) = default;
};
/// "edge (vertices 3, 7) and triangle 40 (vertices 1, 2, 5)"
std::string describe(const compare::Topology& topology, const EdgeThroughTriangle& meeting,
                     const compare::ElementNames& names = {});

/// Ascending; touching counts. Pairs inside one rigid group are left out.
std::vector<EdgeThroughTriangle> intersections(const PairMesh& mesh, const State& x);

}  // namespace ogc::reference
