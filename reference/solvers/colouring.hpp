// Colours of a sweep by the simplest rule there is; a contestant may have better ones, and an ablation has others.
#pragma once

#include <vector>

#include "compare/stages/rest_state.hpp"
#include "reference/solvers/variants/settings.hpp"

namespace ogc::reference {

/// Free vertices in the order of their numbers, each in the lowest colour that none of its stencils has, then turned by
/// component of the conflict graph, (c + k) mod n in the k-th of them; −1 for all others. `groups`: rigid_groups.
/// Colouring::greedy does not turn; `random` takes the vertices in an order that the scene's seed draws, and does not
/// turn; `vertex` and `together` ask no stencil.
std::vector<compare::Index> colours_of(const compare::Scene& scene, const compare::RestStateOut& rest,
                                       const std::vector<compare::Index>& groups, Colouring rule = Colouring::turned);

}  // namespace ogc::reference
