#include "compare/files/text_lines.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>

#include "compare/files/numbers.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool is_end(char c) { return c == '\n' || c == '\r'; }

/// Returns the number of characters before the first that satisfies `is`, or of all characters if none does.
/// std::string_view's search for one of several characters is slower on large files.
template <class Is>
std::size_t before(std::string_view text, Is is) {
  return static_cast<std::size_t>(std::ranges::find_if(text, is) - text.begin());
}

std::size_t comment_in(std::string_view line, char sign) {
  for (std::size_t place = line.find(sign); place != std::string_view::npos; place = line.find(sign, place + 1))
    if (!is_hash_of_number(line, place)) return place;
  return line.size();
}

}  // namespace

std::string_view next_word(std::string_view& text) {
  text.remove_prefix(before(text, std::not_fn(is_blank)));
  const std::string_view word = text.substr(0, before(text, is_blank));
  text.remove_prefix(word.size());
  return word;
}

bool is_hash_of_number(std::string_view text, std::size_t place) {
  if (text[place] != '#' || place < 2 || place + 1 >= text.size()) return false;
  return text[place - 1] == '.' && text[place - 2] == '1' &&
         std::isalpha(static_cast<unsigned char>(text[place + 1])) != 0;
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
  line_ = text_.substr(0, before(text_, is_end));
  text_.remove_prefix(line_.size());
  if (!text_.empty()) text_.remove_prefix(text_.starts_with("\r\n") ? 2 : 1);
  if (rules_.comment != '\0') line_ = line_.substr(0, comment_in(line_, rules_.comment));
  goes_on_ = false;
  if (!rules_.backslash_joins) return true;
  std::string_view rest = line_;
  while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
  if (!rest.ends_with('\\')) return true;
  line_ = rest.substr(0, rest.size() - 1);
  return goes_on_ = true;
}

bool TextLines::next() {
  while (goes_on_) step();
  return step();
}

bool TextLines::next_filled() {
  while (next())
    if (!std::ranges::all_of(line_, is_blank)) return true;
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
