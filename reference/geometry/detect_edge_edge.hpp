// Stage detect_edge_edge: Algorithm 2, Eq. 17, 24, as method.md §1 corrects them.
#pragma once

#include "compare/stages/detect_edge_edge.hpp"

namespace ogc::reference {

/// Edges in parallel; the answer does not depend on the number of threads. Nearly parallel edges count as interior–interior wherever their distance is
/// below r: the points of the contact are projections of each other, so only the slope separates them from the blocks.
compare::DetectEdgeEdgeTruth detect_edge_edge(const compare::DetectIn& in);

/// Its `exact` alone, for solvers: pairs that are too far apart to be a contact or to lower a smallest distance are not examined.
compare::DetectEdgeEdgeOut exact_edge_edge(const compare::DetectIn& in);

}  // namespace ogc::reference
