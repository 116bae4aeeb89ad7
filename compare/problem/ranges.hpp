// Describes and checks the ranges in the tables of settings and materials, for checks, messages and help.
#pragma once

#include <string>

#include "compare/problem/material_table.hpp"
#include "compare/problem/settings.hpp"

namespace ogc::compare {

/// Returns whether the number is not 0 but below the smallest number of single precision. Rounding could turn it into
/// 0, which may have another meaning.
bool vanishes_in_single(double value);

/// Returns "1 to 1024", "0, or 1.401298464324817e-45 to 1", or the names of the choices.
std::string range_text(const SettingInfo& info);
std::string range_text(const MaterialInfo& info);

/// Returns whether a constant may have this value; compare/problem/settings.hpp has in_range for settings.
bool in_range(const MaterialInfo& info, double value);
/// Returns "a number from 1 to 1024 N/m (meaning)".
std::string describe_range(const MaterialInfo& info);

}  // namespace ogc::compare
