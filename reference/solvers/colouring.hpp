// Colours of a sweep by the simplest rule there is; a contestant may have better ones.
#pragma once

#include <vector>

#include "compare/stages/rest_state.hpp"

namespace ogc::reference {

/// Free vertices in the order of their numbers, each in the lowest colour that none of its stencils has, then turned by
/// component of the conflict graph, (c + k) mod n in the k-th of them; −1 for all others. `groups`: rigid_groups.
std::vector<compare::Index> colours_of(const compare::Scene& scene, const compare::RestStateOut& rest,
                                       const std::vector<compare::Index>& groups);

}  // namespace ogc::reference
