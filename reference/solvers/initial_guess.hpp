// Stage initial_guess: the inertia's target (Eq. 28; method.md §4.1, §5.2).
#pragma once

#include "compare/stages/initial_guess.hpp"

namespace ogc::reference {

/// y = xᵗ + h vᵗ + h² a_ext, in long double: rounded at 2⁻⁶² of its terms, then to double.
compare::InitialGuessTruth initial_guess(const compare::InitialGuessIn& in);

}  // namespace ogc::reference
