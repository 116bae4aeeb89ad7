// Stage rest_state: what is computed once of the rest shape (method.md §4.5 to §4.10).
#pragma once

#include <vector>

#include "compare/stages/rest_state.hpp"

namespace ogc::reference {

/// Every value from exact polynomials of the coordinates as given, with one root, quotient or angle in long double; its
/// unit from the derivatives of the same formula. The scene must be as the contract asks.
compare::RestStateTruth rest_state(const compare::RestStateIn& in);

/// The part of it that is of rods: adds the segments to the truth, and half of ρ l of each of a body that moves to its
/// ends [kg].
void add_segments(const compare::RestStateIn& in, compare::RestStateTruth& truth, std::vector<long double>& mass,
                  std::vector<double>& mass_scale);

}  // namespace ogc::reference
