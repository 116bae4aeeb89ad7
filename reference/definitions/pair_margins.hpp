// How far an edge–edge contact is from ending, boundary by boundary, for a look at it.
#pragma once

#include "compare/stages/detect_edge_edge.hpp"
#include "reference/definitions/block_margins.hpp"

namespace ogc::reference {

/// The two conditions of a contact {p, q} (Eq. 17, corrected).
struct PairMargins {
  /// of the point of q closest to p, at the boundaries of U_p^E (Eq. 14, 15), the sphere first
  std::vector<BlockMargin> first;
  std::vector<BlockMargin> second;  ///< of the point of p closest to q, at those of U_q^E
};

/// Signs are exact, for the closest points as quotients; lengths within 8 ulp. Nothing for the interiors of nearly
/// parallel edges, whose contact points are a rule's: the blocks asked about them are those of the features that hold
/// their closest points.
PairMargins pair_margins(const Complex& mesh, const compare::EdgeEdgeContact& contact, float contact_radius);

}  // namespace ogc::reference
