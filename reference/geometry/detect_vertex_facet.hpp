// Stage detect_vertex_facet: Algorithm 1, Eq. 12, 22, 26.
#pragma once

#include "compare/stages/detect_vertex_facet.hpp"

namespace ogc::reference {

/// Detects contacts, in parallel over vertices; the answer does not depend on the number of threads.
compare::DetectVertexFacetTruth detect_vertex_facet(const compare::DetectIn& in);

/// Returns only `exact` of the truth, for solvers. Skips pairs that are too far apart to be a contact or to lower a
/// smallest distance.
compare::DetectVertexFacetOut exact_vertex_facet(const compare::DetectIn& in);

}  // namespace ogc::reference
