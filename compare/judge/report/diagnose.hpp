// Finds what is wrong from failing cases: asks the contestant once about each of them and about a sample of all
// generators, and compares the answers with the known wrong forms of the stage.
#pragma once

#include <span>

#include "compare/judge/engine/diagnosis.hpp"
#include "compare/judge/report/wrong_forms.hpp"

namespace ogc::compare {

/// A form is named where it fits at least `least_fits` failing cases, and `least_share` of those that were looked at.
/// One case may fit by accident. A few in a hundred may miss, because a second error, or a rounding of the form's own
/// changed input, moves them out of the tolerance.
inline constexpr std::uint64_t least_fits = 3;
inline constexpr double least_share = 0.9;
/// Where no form fits that many, a kernel may have two mistakes. A form that fits `least_share_of_first` is named, with
/// those that fit the rest; or all of them, whatever the share of the first, where they fit `least_share` together.
/// Each further form fits `least_share_of_second` of the failing cases and `least_share_of_right` of the right ones: a
/// form that fits a part of the failing ones by accident contradicts right ones.
inline constexpr double least_share_of_first = 0.5, least_share_of_second = 0.05, least_share_of_right = 0.99;

/// Returns the diagnosis. `failing` are cases of the stage with a wrong answer (without those to which there is no
/// answer); `seed` is that of the sample.
Diagnosis diagnose(Stage stage, std::span<const TestCase> failing, const Contestant& contestant,
                   const Authority& authority, std::uint64_t seed);

}  // namespace ogc::compare
