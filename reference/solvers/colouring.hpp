// Colours the vertices for a sweep by the simplest rule, and by other rules for ablations. A contestant may use a
// better colouring.
#pragma once

#include <vector>

#include "compare/stages/rest_state.hpp"
#include "reference/solvers/variants/settings.hpp"

namespace ogc::reference {

/// Returns a colour for each free vertex, −1 for all others; `groups` is the result of rigid_groups. Colouring::turned
/// works in two passes. First it visits the free vertices in the order of their numbers and gives each the lowest
/// colour that no vertex of its stencils has. Then it replaces the colour c in the k-th component of the conflict graph
/// by (c + k) mod n. The other rules differ:
/// - greedy: omits the second pass
/// - random: omits the second pass, and visits the vertices in an order drawn from the scene's seed
/// - vertex, together: ignore the stencils
std::vector<compare::Index> colours_of(const compare::Scene& scene, const compare::RestStateOut& rest,
                                       const std::vector<compare::Index>& groups, Colouring rule = Colouring::turned);

}  // namespace ogc::reference
