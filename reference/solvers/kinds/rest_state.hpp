// Stage rest_state: what is computed once of the rest shape (method.md §4.5 to §4.10).
#pragma once

#include "compare/stages/rest_state.hpp"

namespace ogc::reference {

/// Every value from exact polynomials of the coordinates as given, with one root, quotient or angle in long double; its
/// unit from the derivatives of the same formula. The scene must be as the contract asks.
compare::RestStateTruth rest_state(const compare::RestStateIn& in);

}  // namespace ogc::reference
