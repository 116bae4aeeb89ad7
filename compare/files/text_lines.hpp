// Takes lines and words off a text file of a mesh; errors name the file and the line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ogc::compare {

/// Takes the first word off `text`, with the blanks before it; empty if only blanks are left. Line ends are blanks.
std::string_view next_word(std::string_view& text);

/// Returns whether the '#' at `place` belongs to a non-number that Windows programs print ("-1.#IND", "1.#INF",
/// "1.#QNAN", "1.#R"); then it begins no comment.
bool is_hash_of_number(std::string_view text, std::size_t place);

/// Returns the error for a word that should be a finite number: "'nan' is no finite coordinate; give three numbers
/// [m]".
std::string no_coordinate(std::string_view word);

/// Rules for reading a format's lines.
struct LineRules {
  char comment = '\0';           ///< character that begins a comment up to the line's end; '\0': none
  bool backslash_joins = false;  ///< whether a line that ends in a backslash continues in the next one
};

/// Reads a text line by line, and each line word by word. Lines end with a line feed, a carriage return or both. The
/// text and the name must outlive the reader.
class TextLines {
 public:
  /// Starts before the first line; `name` is the file's name in errors.
  TextLines(std::string_view text, const std::string& name, LineRules rules = {})
      : text_(text), name_(name), rules_(rules) {}

  bool next();                                     ///< goes to the next line; false after the last line
  bool next_filled();                              ///< goes to the next line that has a word
  std::string_view word();                         ///< the line's next word; empty at its end
  std::string_view far_word();                     ///< the next word of this line or of a later one
  std::string_view rest() const { return line_; }  ///< rest of the line after the words that were read
  double coordinate();                             ///< the next word [m]; fails if it is no finite number
  /// converts a word that was already read; fails if it is no finite number
  double coordinate(std::string_view found) const;
  std::size_t number() const { return number_; }           ///< number of the line, from 1; 0 before the first
  std::size_t bytes_left() const { return text_.size(); }  ///< bytes after this line

  /// Returns the next word as a whole number. For another word, or none, throws InputError that names `what`.
  std::int64_t integer(const std::string& what) { return integer(word(), what); }
  /// Converts the word `found`, which was already read, to a whole number. For another word throws InputError that
  /// names `what`.
  std::int64_t integer(std::string_view found, const std::string& what) const;
  /// Returns the number of entries that the word `found` announces. Fails if the rest of the file has fewer than
  /// `least` bytes per entry.
  std::size_t count(std::string_view found, const std::string& what, std::size_t least = 1) const;

  /// Goes to the next line that has a word. If the file ends before it, throws InputError that names `what`.
  void expect_filled(const std::string& what);
  /// Returns the next word of this line or of a later line. If there is none, throws InputError that names `what`.
  std::string_view expect_word(const std::string& what);
  /// Throws InputError: the file ends before `what`.
  [[noreturn]] void fail_truncated(const std::string& what) const;
  /// Throws InputError "FILE: line N: what", at this line or at another.
  [[noreturn]] void fail(const std::string& what) const { fail_at(number_, what); }
  [[noreturn]] void fail_at(std::size_t number, const std::string& what) const;

 private:
  bool step();  ///< goes to the next line, even if it is joined to this one

  std::string_view text_, line_;
  const std::string& name_;
  LineRules rules_;
  std::size_t number_ = 0;
  bool goes_on_ = false;  ///< whether the next line is joined to this one
};

}  // namespace ogc::compare
