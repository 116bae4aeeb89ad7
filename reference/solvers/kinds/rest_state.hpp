// Stage rest_state: the constants of the rest shape (method.md §4.5 to §4.10).
#pragma once

#include "compare/stages/rest_state.hpp"

namespace ogc::reference {

/// Computes every value from exact polynomials of the given coordinates, with one root, quotient or angle in long
/// double. Error scales come from the derivatives of the same formula. `in` must be as RestStateIn describes.
compare::RestStateTruth rest_state(const compare::RestStateIn& in);

}  // namespace ogc::reference
