// What edge pairs generate, before equal pairs of faces become one contact under their lowest-numbered edges.
#pragma once

#include <vector>

#include "compare/stages/detect_edge_edge.hpp"
#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// Edges `edge` < `other` generate the contact `faces`, exactly or possibly.
struct Generated {
  FacePair faces;               ///< the contact
  Index edge = -1, other = -1;  ///< that generate it
  bool exact = false;           ///< the exact answer of Algorithm 2
  bool certain = false;         ///< exact, and no grey boundary is near
  friend auto operator<=>(const Generated&, const Generated&) = default;
};

/// A doubtful pair of faces that nothing replaces on the other side of a boundary, or (`joined`) that another one
/// replaces.
struct Doubt {
  FacePair faces, other;  ///< the doubtful pair, and the one that replaces it
  bool joined = false;    ///< whether one does
};

/// The canonical contacts of a list of generated pairs in any order, and the grey decisions.
struct Assembled {
  std::vector<compare::EdgeEdgeContact> contacts;                     ///< in canonical order
  std::vector<compare::GreyDecision<compare::EdgeEdgeContact>> grey;  ///< all there are
};
/// Equal pairs of faces as one contact each, with its decision.
Assembled assemble(const Complex& mesh, std::vector<Generated> generated, const std::vector<Doubt>& doubts);

}  // namespace ogc::reference
