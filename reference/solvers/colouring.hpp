// Colours the vertices for a sweep by the simplest rule. A contestant may have better colours; ablations use other
// rules.
#pragma once

#include <vector>

#include "compare/stages/rest_state.hpp"
#include "reference/solvers/variants/settings.hpp"

namespace ogc::reference {

/// Returns a colour for each free vertex, −1 for all others. Visits the free vertices in the order of their numbers and
/// gives each the lowest colour that no neighbour in a stencil has. Then replaces the colours c of the k-th component
/// of the conflict graph by (c + k) mod n. `groups`: rigid_groups. Colouring::greedy and `random` leave out this last
/// step; `random` visits the vertices in an order drawn from the scene's seed. `vertex` and `together` ignore the
/// stencils.
std::vector<compare::Index> colours_of(const compare::Scene& scene, const compare::RestStateOut& rest,
                                       const std::vector<compare::Index>& groups, Colouring rule = Colouring::turned);

}  // namespace ogc::reference
