// Measures, boundary by boundary, how far an edge–edge contact is from ending, so that a user can inspect the contact.
#pragma once

#include "compare/stages/detect_edge_edge.hpp"
#include "reference/definitions/block_margins.hpp"

namespace ogc::reference {

/// The margins of a contact {p, q} at the boundaries of both blocks (Eq. 17, corrected).
struct PairMargins {
  /// for the point of q closest to p: its margins at all boundaries of U_p^E (Eq. 14, 15), the sphere first
  std::vector<BlockMargin> first;
  std::vector<BlockMargin> second;  ///< for the point of p closest to q: its margins at all boundaries of U_q^E
};

/// Returns the margins of a contact. Signs are exact, lengths are within 8 ulp. Both lists are empty for the interiors
/// of nearly parallel edges, whose contact points need not be the closest points and need not lie in blocks (method.md
/// §1.4).
PairMargins pair_margins(const Complex& mesh, const compare::EdgeEdgeContact& contact, float contact_radius);

}  // namespace ogc::reference
