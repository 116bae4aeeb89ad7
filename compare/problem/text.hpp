// What error messages share: the nearest known name, and numbers that read back as the same double.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ogc::compare {

/// The first known name that begins with `name`; otherwise the first of those with the fewest insertions, deletions and replacements to it. Empty where
/// `known` is.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known);

/// "unknown WHAT 'NAME'; did you mean 'NEAREST'?": the beginning of every complaint about a name.
std::string unknown_name(std::string_view what, std::string_view name, std::span<const std::string_view> known);

/// The shortest decimal text that reads back as the same double.
std::string shortest(double value);

/// What a person would have typed: where single precision holds the value exactly, the double nearest to the shortest decimal text of the float
/// (0.01 for 0.009999999776482582), which rounds to the same float; otherwise the value itself.
double as_typed(double value);

}  // namespace ogc::compare
