// From failing cases to what is wrong: asks the contestant once about each of them and about a sample of all
// generators, and holds the answers to the known wrong forms of the stage.
#pragma once

#include <span>

#include "compare/judge/engine/diagnosis.hpp"
#include "compare/judge/report/wrong_forms.hpp"

namespace ogc::compare {

/// A form is named where it fits at least so many failing cases, and this share of those that were looked at: one case
/// may fit by accident; a few in a hundred may miss because a second error, or a rounding of the form's own changed
/// input, moves them out of the tolerance.
inline constexpr std::uint64_t least_fits = 3;
inline constexpr double least_share = 0.9;
/// Where no form fits so many, a kernel may have two mistakes: a form that fits this share is named, and those that
/// fit the rest; or all of them, whatever the share of the first, where they fit `least_share` together. Each fits this
/// much of the failing cases and of the right ones: what fits a part of the failing ones by accident is at odds with
/// others.
inline constexpr double least_share_of_first = 0.5, least_share_of_second = 0.05, least_share_of_right = 0.99;

/// `failing`: cases of the stage with a wrong answer (cases without an answer are left out). `seed`: of the sample.
Diagnosis diagnose(Stage stage, std::span<const TestCase> failing, const Contestant& contestant,
                   const Authority& authority, std::uint64_t seed);

}  // namespace ogc::compare
