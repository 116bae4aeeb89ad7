// A reader that takes lines and words off a mesh file in text. Its errors name the file and the line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ogc::compare {

/// Takes the first word off `text`, with the blanks before it; empty where only blanks are left. Ends of lines are
/// blanks.
std::string_view next_word(std::string_view& text);

/// Whether the '#' at `place` belongs to a word of Windows programs that is no number ("-1.#IND", "1.#INF", "1.#QNAN",
/// "1.#R"), and begins no comment.
bool is_hash_of_number(std::string_view text, std::size_t place);

/// What a word is that stands where a finite number should: "'nan' is no finite coordinate; give three numbers [m]".
std::string no_coordinate(std::string_view word);

/// How a format's lines are read.
struct LineRules {
  char comment = '\0';           ///< the rest of the line behind it is left out; none: '\0'
  bool backslash_joins = false;  ///< a line that ends in a backslash goes on in the next one
};

/// A text line by line, and each line word by word; lines end with a line feed, a carriage return or both. The text and
/// the name must outlive it.
class TextLines {
 public:
  /// Before the first line; `name` is the file's, for errors.
  TextLines(std::string_view text, const std::string& name, LineRules rules = {})
      : text_(text), name_(name), rules_(rules) {}

  bool next();                                             ///< to the next line; false behind the last
  bool next_filled();                                      ///< to the next line that has a word
  std::string_view word();                                 ///< the line's next word; empty at its end
  std::string_view far_word();                             ///< the next word of this line or of a later one
  std::string_view rest() const { return line_; }          ///< of the line, behind the words taken so far
  double coordinate();                                     ///< the next word [m]; fails where it isn't finite
  double coordinate(std::string_view found) const;         ///< the same of a word that was taken
  std::size_t number() const { return number_; }           ///< of the line, from 1; 0 before the first
  std::size_t bytes_left() const { return text_.size(); }  ///< behind this line

  /// The next word, a whole number; fails where it is none: `what` should stand there.
  std::int64_t integer(const std::string& what) { return integer(word(), what); }
  std::int64_t integer(std::string_view found, const std::string& what) const;  ///< the same of a word that was taken
  /// A number of entries that follow, of `least` bytes each: fails where the file has not so many bytes left.
  std::size_t count(std::string_view found, const std::string& what, std::size_t least = 1) const;

  /// To the next line that has a word; throws InputError where the file ends: `what` should stand there.
  void expect_filled(const std::string& what);
  /// The next word of this line or a later one, in the same way.
  std::string_view expect_word(const std::string& what);
  /// Throws InputError: the file ends, where `what` should stand.
  [[noreturn]] void fail_truncated(const std::string& what) const;
  /// Throws InputError "FILE: line N: what", at this line or at another.
  [[noreturn]] void fail(const std::string& what) const { fail_at(number_, what); }
  [[noreturn]] void fail_at(std::size_t number, const std::string& what) const;

 private:
  bool step();  ///< to the next line, whether it is joined to this one or not

  std::string_view text_, line_;
  const std::string& name_;
  LineRules rules_;
  std::size_t number_ = 0;
  bool goes_on_ = false;  ///< this line is joined to the next one
};

}  // namespace ogc::compare
