#include "compare/files/text_lines.hpp"

#include <algorithm>
#include <cmath>

#include "compare/files/numbers.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

constexpr std::string_view blanks = " \t\r\n\f\v";

std::size_t comment_in(std::string_view line, char sign) {
  for (std::size_t place = line.find(sign); place != std::string_view::npos; place = line.find(sign, place + 1))
    if (!is_hash_of_number(line, place)) return place;
  return line.size();
}

}  // namespace

std::string_view next_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(blanks));
  text.remove_prefix(word.size());
  return word;
}

bool is_hash_of_number(std::string_view text, std::size_t place) {
  if (text[place] != '#' || place < 2 || place + 1 >= text.size()) return false;
  const char behind = text[place + 1];
  return text[place - 1] == '.' && text[place - 2] == '1' && behind >= 'A' && behind <= 'Z';
}

std::string no_coordinate(std::string_view word) {
  const std::size_t hash = word.find('#');
  const bool is_windows = hash != std::string_view::npos && is_hash_of_number(word, hash);
  return "'" + shown(word) + "' is no finite coordinate" +
         (is_windows ? " but what programs for Windows print for infinity or for no number" : "") +
         "; give three numbers [m]";
}

bool TextLines::step() {
  if (text_.empty()) return goes_on_ = false;
  ++number_;
  line_ = text_.substr(0, text_.find_first_of("\r\n"));
  text_.remove_prefix(line_.size());
  if (!text_.empty()) text_.remove_prefix(text_.starts_with("\r\n") ? 2 : 1);
  if (rules_.comment != '\0') line_ = line_.substr(0, comment_in(line_, rules_.comment));
  goes_on_ = false;
  if (!rules_.backslash_joins) return true;
  const std::size_t last = line_.find_last_not_of(blanks);
  if (last == std::string_view::npos || line_[last] != '\\') return true;
  line_ = line_.substr(0, last);
  return goes_on_ = true;
}

bool TextLines::next() {
  while (goes_on_) step();
  return step();
}

bool TextLines::next_filled() {
  while (next())
    if (line_.find_first_not_of(blanks) != std::string_view::npos) return true;
  return false;
}

std::string_view TextLines::word() {
  std::string_view found = next_word(line_);
  while (found.empty() && goes_on_ && step()) found = next_word(line_);
  return found;
}

std::string_view TextLines::far_word() {
  std::string_view found = word();
  while (found.empty() && next()) found = word();
  return found;
}

double TextLines::coordinate() { return coordinate(word()); }

double TextLines::coordinate(std::string_view found) const {
  double value = 0;
  if (!parse_number(found, value) || !std::isfinite(value)) fail(no_coordinate(found));
  return value;
}

std::int64_t TextLines::integer(std::string_view found, const std::string& what) const {
  std::int64_t value = 0;
  if (!parse_number(found, value)) fail("'" + shown(found) + "' is no whole number: " + what + " should stand there");
  return value;
}

std::size_t TextLines::count(std::string_view found, const std::string& what, std::size_t least) const {
  const std::int64_t value = integer(found, what);
  if (value < 0 || static_cast<std::uint64_t>(value) > (line_.size() + text_.size() + 1) / least)
    fail(std::to_string(value) + " is no possible " + what + ", as " + std::to_string(line_.size() + text_.size()) +
         " bytes follow: the file is truncated or damaged");
  return static_cast<std::size_t>(value);
}

void TextLines::expect_filled(const std::string& what) {
  if (!next_filled()) fail_truncated(what);
}

std::string_view TextLines::expect_word(const std::string& what) {
  const std::string_view found = far_word();
  if (found.empty()) fail_truncated(what);
  return found;
}

void TextLines::fail_truncated(const std::string& what) const {
  throw InputError(name_ + ": ends after line " + std::to_string(number_) + ", where " + what +
                   " should stand: the file is truncated; write it again");
}

void TextLines::fail_at(std::size_t number, const std::string& what) const {
  throw InputError(name_ + ": line " + std::to_string(number) + ": " + what);
}

}  // namespace ogc::compare
