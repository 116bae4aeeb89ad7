// Lists which solver reads which setting. A value that a solver would ignore is rejected.
#pragma once

#include <span>
#include <string_view>

#include "compare/problem/settings.hpp"

namespace ogc::compare {

/// A setting for which a solver accepts only one value.
struct RequiredSetting {
  std::string_view solver, setting, value;  ///< "penalty", "bounds", "off"
};

/// Returns all rows.
std::span<const RequiredSetting> required_settings();

/// Throws InputError if a setting has a value that the solver does not read or does not accept. The message names the
/// setting, its value and the solvers that read it. `solver` is "vbd", "newton", "reference_vbd", "ipc" or "penalty".
void refuse_unread(const Settings& settings, std::string_view solver);

}  // namespace ogc::compare
