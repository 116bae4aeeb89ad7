#include "compare/files/meshes/text_lines.hpp"

#include <algorithm>
#include <cmath>

#include "compare/files/numbers.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {

std::string_view next_word(std::string_view& text) {
  constexpr std::string_view blanks = " \t\r\n\f\v";
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(blanks));
  text.remove_prefix(word.size());
  return word;
}

bool TextLines::next() {
  if (text_.empty()) return false;
  ++number_;
  line_ = text_.substr(0, text_.find('\n'));
  text_.remove_prefix(std::min(line_.size() + 1, text_.size()));
  return true;
}

double TextLines::coordinate() {
  const std::string_view found = word();
  double value = 0;
  if (!parse_number(found, value) || !std::isfinite(value))
    fail("'" + shown(found) + "' is no finite coordinate; give three numbers [m]");
  return value;
}

void TextLines::fail_at(std::size_t number, const std::string& what) const {
  throw InputError(name_ + ": line " + std::to_string(number) + ": " + what);
}

}  // namespace ogc::compare
