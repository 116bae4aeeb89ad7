// Stage initial_guess: the inertial target (Eq. 28; method.md §4.1, §5.2).
#pragma once

#include "compare/stages/initial_guess.hpp"

namespace ogc::reference {

/// Computes y = xᵗ + h vᵗ + h² a_ext in long double. Each term has a relative error of 2⁻⁶²; the sum is rounded to
/// double.
compare::InitialGuessTruth initial_guess(const compare::InitialGuessIn& in);

}  // namespace ogc::reference
