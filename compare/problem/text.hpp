// What error messages share: names that were meant and names that there are, and numbers that read back as the same
// double.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ogc::compare {

/// The known name that was meant, whatever the case of letters: the first that begins with `name`; otherwise the first
/// of those that the fewest typing errors (a letter left out, added, replaced, two letters swapped) lead to, at most
/// one in three letters; otherwise the first that `name` abbreviates: three letters or more, in its order, from its
/// first. Empty where there is none.
std::string_view near_name(std::string_view name, std::span<const std::string_view> known);

/// "unknown WHAT 'NAME'; did you mean 'NEAR'? There are: A, B, C": the beginning of every complaint about a name.
/// Without a near one it does not ask; of many known names it lists the first.
std::string unknown_name(std::string_view what, std::string_view name, std::span<const std::string_view> known);

/// "A, B, C".
std::string joined(std::span<const std::string_view> names);

/// A text as messages show it: cut after so many bytes.
std::string shown(std::string_view text, std::size_t most = 40);

/// The shortest decimal text that reads back as the same double.
std::string shortest(double value);

/// What a person would have typed: where single precision holds the value exactly, the double nearest to the shortest
/// decimal text of the float (0.01 for 0.009999999776482582), which rounds to the same float; otherwise the value
/// itself.
double as_typed(double value);

}  // namespace ogc::compare
