// Reads numbers in text files strictly: the whole word or nothing.
#pragma once

#include <charconv>
#include <string_view>

namespace ogc::compare {

/// Returns whether `word` is exactly one number; a leading '+' is allowed, as printf writes it. Overflow and underflow
/// to zero are not accepted.
template <class Number>
bool parse_number(std::string_view word, Number& number) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc{} && end == word.data() + word.size();
}

}  // namespace ogc::compare
