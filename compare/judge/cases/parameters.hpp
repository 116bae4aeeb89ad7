// Handles parameters of a case that a problem string may set after the case is made: `… index=1234 r=2e-3`. Each stage
// has a few of its own.
#pragma once

#include <span>
#include <string_view>

#include "compare/judge/cases/cases.hpp"

namespace ogc::compare {

/// One parameter of a stage.
struct ParameterInfo {
  std::string_view name, meaning;  ///< "r"; "contact radius [m]"
  float minimum, maximum;          ///< inclusive limits of the stage's contract
};

/// Returns the parameters of a stage in canonical order; none where a case has nothing but coordinates.
std::span<const ParameterInfo> parameters(Stage stage);

/// Puts values into canonical order. Throws InputError for a name that the stage does not have (and lists those it
/// has), a value out of range, or a name given twice.
void make_canonical(Stage stage, std::vector<Override>& overrides);

/// Puts the values of `test.name.overrides` into the case. Throws InputError where the question becomes illegal (a
/// query radius below the contact radius).
void apply_overrides(TestCase& test);

}  // namespace ogc::compare
