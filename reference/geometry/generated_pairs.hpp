// Merges the contacts that pairs of edges generate. Several edge pairs can generate the same pair of faces; it becomes
// one contact with its lowest-numbered edges.
#pragma once

#include <vector>

#include "compare/stages/detect_edge_edge.hpp"
#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// A contact that the edges `edge` < `other` generate, certainly or possibly.
struct Generated {
  FacePair faces;               ///< the contact
  Index edge = -1, other = -1;  ///< the edges that generate it
  bool exact = false;           ///< whether Algorithm 2 generates it in exact arithmetic
  bool certain = false;         ///< whether no grey decision can remove it
  friend auto operator<=>(const Generated&, const Generated&) = default;
};

/// Holds a doubtful pair of faces: rounding may put it beyond one of its boundaries. There `other` is the contact (if
/// `joined`), or there is no contact.
struct Doubt {
  FacePair faces, other;  ///< the doubtful pair, and the pair that replaces it
  bool joined = false;    ///< whether `other` replaces `faces`
};

/// The canonical contacts of a detection, and its grey decisions.
struct Assembled {
  std::vector<compare::EdgeEdgeContact> contacts;                     ///< the exact answer
  std::vector<compare::GreyDecision<compare::EdgeEdgeContact>> grey;  ///< every decision that rounding could change
};
/// Merges equal pairs of faces into one contact each, and collects the grey decisions. `generated` may have any order.
Assembled assemble(const Complex& mesh, std::vector<Generated> generated, const std::vector<Doubt>& doubts);

}  // namespace ogc::reference
