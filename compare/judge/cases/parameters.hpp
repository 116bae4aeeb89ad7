// Sets parameters of a case after it is made, as a problem string gives them: `… index=1234 r=2e-3`. Each stage has a
// few parameters of its own.
#pragma once

#include <span>
#include <string_view>

#include "compare/judge/cases/cases.hpp"

namespace ogc::compare {

/// A parameter of a stage.
struct ParameterInfo {
  std::string_view name, meaning;  ///< "r"; "contact radius [m]"
  float minimum, maximum;          ///< limits of the stage's contract, inclusive
};

/// Returns the parameters of a stage in canonical order; empty if a case has nothing but coordinates.
std::span<const ParameterInfo> parameters(Stage stage);

/// Sorts values into canonical order. Throws InputError for a name that the stage lacks (and lists the known names), a
/// value out of range, or a name given twice.
void make_canonical(Stage stage, std::vector<Override>& overrides);

/// Puts the values of `test.name.overrides` into the case. Throws InputError if the question becomes illegal, for
/// example by a query radius below the contact radius.
void apply_overrides(TestCase& test);

}  // namespace ogc::compare
