// Writes what error messages share: the known name that a user probably meant, lists of names, and numbers that read
// back as the same double.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ogc::compare {

/// Returns the known name that was probably meant, ignoring the case of letters: the first that begins with `name`;
/// otherwise the first of those with the fewest typing errors (a letter left out, added, replaced, two letters
/// swapped), at most one in three letters; otherwise the first that `name` abbreviates with at least three letters, in
/// order, starting with its first. Empty if there is none.
std::string_view near_name(std::string_view name, std::span<const std::string_view> known);

/// Returns "unknown WHAT 'NAME'; did you mean 'NEAR'? There are: A, B, C": the beginning of every error about a name.
/// The question is left out without a near name; of many known names the first are listed.
std::string unknown_name(std::string_view what, std::string_view name, std::span<const std::string_view> known);

/// Returns "A, B, C".
std::string joined(std::span<const std::string_view> names);

/// Returns a text for a message, cut after `most` bytes.
std::string shown(std::string_view text, std::size_t most = 40);

/// Returns the shortest decimal text that reads back as the same double.
std::string shortest(double value);

/// Returns the number that a person would have typed: if single precision holds the value exactly, the double nearest
/// to the shortest decimal text of the float (0.01 for 0.009999999776482582), which rounds to the same float; otherwise
/// the value itself.
double as_typed(double value);

}  // namespace ogc::compare
