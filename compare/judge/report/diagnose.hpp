// Finds the cause of failing cases. Asks the contestant once for each failing case and for a sample of all generators.
// Compares the answers with the known wrong forms of the stage.
#pragma once

#include <span>

#include "compare/judge/engine/diagnosis.hpp"
#include "compare/judge/report/wrong_forms.hpp"

namespace ogc::compare {

/// A form is named if it fits at least `least_fits` of the failing cases that were tried, and at least the share
/// `least_share` of them. One case may fit by chance. A few cases in a hundred may not fit the right form, because of a
/// second mistake, or because the form changes an input and rounds it.
inline constexpr std::uint64_t least_fits = 3;
inline constexpr double least_share = 0.9;
/// A kernel may have two mistakes. So further forms are fitted to the failing cases that the named form does not fit,
/// or to all failing cases if no form fits the share `least_share`.
/// - If no form fits `least_share`, several forms are named together: the first must fit `least_share_of_first` of the
///   failing cases, or all together must fit `least_share`.
/// - Each of these forms must fit `least_share_of_second` of the failing cases, and `least_share_of_right` of the right
///   ones: a form that fits some failing cases by chance contradicts right cases.
inline constexpr double least_share_of_first = 0.5, least_share_of_second = 0.05, least_share_of_right = 0.99;

/// Returns the diagnosis. `failing` are cases of the stage with a wrong answer; cases that got no answer are left out.
/// `seed` is the seed of the sample.
Diagnosis diagnose(Stage stage, std::span<const TestCase> failing, const Contestant& contestant,
                   const Authority& authority, std::uint64_t seed);

}  // namespace ogc::compare
