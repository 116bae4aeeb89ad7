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

/// Returns whether any contestant that is linked into this program declares settings.
bool has_declared_settings();
/// Sets a setting that a contestant declares. Does nothing in a program whose contestants declare none, such as one
/// that links ogc::fast alone: nothing there reads the setting. Otherwise throws as set_setting does.
template <class Value>
void set_declared(Settings& settings, std::string_view name, Value value) {
  if (has_declared_settings()) set_setting(settings, name, value);
}

}  // namespace ogc::compare
