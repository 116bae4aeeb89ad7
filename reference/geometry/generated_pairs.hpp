// The contacts that edge pairs generate. Equal pairs of faces become one contact under their lowest-numbered edges.
#pragma once

#include <vector>

#include "compare/stages/detect_edge_edge.hpp"
#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// A contact `faces` that edges `edge` < `other` generate, exactly or possibly.
struct Generated {
  FacePair faces;               ///< the contact
  Index edge = -1, other = -1;  ///< the edges that generate it
  bool exact = false;           ///< the exact answer of Algorithm 2
  bool certain = false;         ///< exact, and no grey boundary is near
  friend auto operator<=>(const Generated&, const Generated&) = default;
};

/// A doubtful pair of faces: on the other side of one of its boundaries another pair replaces it (`joined`), or nothing
/// does.
struct Doubt {
  FacePair faces, other;  ///< the doubtful pair, and the one that replaces it
  bool joined = false;    ///< whether `other` replaces it
};

/// The canonical contacts of a list of generated pairs in any order, and the grey decisions.
struct Assembled {
  std::vector<compare::EdgeEdgeContact> contacts;                     ///< all grey decisions
  std::vector<compare::GreyDecision<compare::EdgeEdgeContact>> grey;  ///< all there are
};
/// Makes one contact of equal pairs of faces each, with its decision.
Assembled assemble(const Complex& mesh, std::vector<Generated> generated, const std::vector<Doubt>& doubts);

}  // namespace ogc::reference
