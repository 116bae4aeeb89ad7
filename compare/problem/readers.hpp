// Which solver reads which setting: a value that a solver would not read is refused, in place of a run that ignores it.
#pragma once

#include <span>
#include <string_view>

#include "compare/problem/settings.hpp"

namespace ogc::compare {

/// What a solver has at one value alone.
struct RequiredSetting {
  std::string_view solver, setting, value;  ///< "penalty", "bounds", "off"
};

/// All of them.
std::span<const RequiredSetting> required_settings();

/// Throws InputError where a setting has a value that the solver does not read, or not the one that it requires: it
/// names the setting, its value and who reads it. `solver`: "vbd", "newton", "reference_vbd", "ipc" or "penalty".
void refuse_unread(const Settings& settings, std::string_view solver);

}  // namespace ogc::compare
