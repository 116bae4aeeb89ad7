// Measures how far an edge–edge contact is from ending, boundary by boundary, for inspection.
#pragma once

#include "compare/stages/detect_edge_edge.hpp"
#include "reference/definitions/block_margins.hpp"

namespace ogc::reference {

/// The two conditions of a contact {p, q} (Eq. 17, corrected).
struct PairMargins {
  /// of the point of q closest to p, at the boundaries of U_p^E (Eq. 14, 15), the sphere first
  std::vector<BlockMargin> first;
  std::vector<BlockMargin> second;  ///< of the point of p closest to q, at the boundaries of U_q^E
};

/// Returns the margins of a contact. Signs are exact, lengths are within 8 ulp. Empty for the interiors of nearly
/// parallel edges: a rule gives their contact points, and their blocks are tested at the features with the closest
/// points.
PairMargins pair_margins(const Complex& mesh, const compare::EdgeEdgeContact& contact, float contact_radius);

}  // namespace ogc::reference
