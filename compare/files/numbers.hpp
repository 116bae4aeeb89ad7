// Reads numbers in text files strictly: a word must be one number as a whole.
#pragma once

#include <charconv>
#include <string_view>

namespace ogc::compare {

/// Returns whether the whole `word` is one number, and stores it in `number`. A leading '+' is allowed, because printf
/// writes it. Overflow and underflow to zero are errors.
template <class Number>
bool parse_number(std::string_view word, Number& number) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc{} && end == word.data() + word.size();
}

}  // namespace ogc::compare
