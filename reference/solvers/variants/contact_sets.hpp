// Contact sets other than the method's, for ablations (§2.2, Fig. 2 of the paper).
#pragma once

#include <span>
#include <vector>

#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"
#include "reference/solvers/variants/settings.hpp"

namespace ogc::reference {

/// The contacts of one set.
struct ListedContacts {
  std::vector<compare::VertexFacetContact> vertex_facet;  ///< sorted by vertex and triangle
  std::vector<compare::EdgeEdgeContact> edge_edge;        ///< sorted by the pairs of edges that generate them
};

/// Returns the contacts nearer than in.contact_radius; does not read in.query_radius. `body` holds the body of each
/// vertex. Throws std::logic_error for ContactSet::ogc.
///
/// - pairs: for each non-adjacent vertex and triangle, and for each pair of non-adjacent edges, their closest faces.
///   Blocks are not tested. A face that is closest in several pairs is listed several times, and its force multiplied.
/// - distance: for each vertex the closest face of each other body. If several triangles are equally close, the
///   lowest-numbered one is used. Edges have no contacts.
ListedContacts contact_variant(ContactSet set, const compare::DetectIn& in, std::span<const compare::Index> body);

}  // namespace ogc::reference
