// Stage detect_edge_edge: Algorithm 2, Eq. 17, 24, as method.md §1.2 to §1.5 correct them.
#pragma once

#include "compare/stages/detect_edge_edge.hpp"

namespace ogc::reference {

/// Detects contacts, in parallel over edges; the answer does not depend on the number of threads. Nearly parallel edges
/// nearer than r count as interior–interior in two cases: each closest point lies in the block of the other edge's
/// face, or neither edge has a triangle.
compare::DetectEdgeEdgeTruth detect_edge_edge(const compare::DetectIn& in);

/// Returns only `exact` of the truth, for solvers. Skips pairs that are too far apart to be a contact or to lower a
/// smallest distance.
compare::DetectEdgeEdgeOut exact_edge_edge(const compare::DetectIn& in);

}  // namespace ogc::reference
