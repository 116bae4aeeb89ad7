// Contact sets that are not the method's, for ablations (§2.2, Fig. 2 of the paper).
#pragma once

#include <span>
#include <vector>

#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"
#include "reference/solvers/variants/settings.hpp"

namespace ogc::reference {

/// What a set lists.
struct ListedContacts {
  std::vector<compare::VertexFacetContact> vertex_facet;  ///< by vertex and triangle
  std::vector<compare::EdgeEdgeContact> edge_edge;        ///< by the edges that generate them
};

/// The contacts nearer than in.contact_radius; in.query_radius is not read. `body`: by vertex.
///
/// ContactSet::pairs: of each vertex and triangle, and of each two edges, that are no neighbours the closest faces of
/// the two. A face that is closest in several pairs is listed as often, so that its force is a multiple; no block is
/// asked. ContactSet::distance: of each vertex the closest face of each other body, the lowest-numbered triangle's
/// where several are as near; edges have none. Throws std::logic_error for the method's own set.
ListedContacts contact_variant(ContactSet set, const compare::DetectIn& in, std::span<const compare::Index> body);

}  // namespace ogc::reference
