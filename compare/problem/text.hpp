// Writes parts that error messages share: the known name that a user probably meant, lists of names, and numbers that
// read back as the same double.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ogc::compare {

/// Returns the known name that was probably meant, ignoring the case of letters; empty if there is none. It is the
/// first of these that exists:
///
/// - the first name that begins with `name`;
/// - the first name with the fewest typing errors (a letter left out, added or replaced, or two letters swapped), at
///   most one in three letters;
/// - the first name that `name` abbreviates: at least three of its letters, in order, starting with its first letter.
std::string_view near_name(std::string_view name, std::span<const std::string_view> known);

/// Returns "unknown WHAT 'NAME'; did you mean 'NEAR'? There are: A, B, C", with which every error about a name begins.
/// The question is left out if there is no near name; if many names are known, only the first are listed.
std::string unknown_name(std::string_view what, std::string_view name, std::span<const std::string_view> known);

/// Returns "A, B, C".
std::string joined(std::span<const std::string_view> names);

/// Returns the text for a message, cut after `most` bytes.
std::string shown(std::string_view text, std::size_t most = 40);

/// Returns the shortest decimal text that reads back as the same double.
std::string shortest(double value);

/// Returns the number that a person would have typed. If the value is exactly a number of single precision, this is the
/// shortest decimal number that rounds to the same float (0.01 for 0.009999999776482582). Otherwise it is the value
/// itself.
double as_typed(double value);

}  // namespace ogc::compare
