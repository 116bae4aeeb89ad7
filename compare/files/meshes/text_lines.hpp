// Lines and words of mesh files in text; errors name the file and the line.
#pragma once

#include <string>
#include <string_view>

namespace ogc::compare {

/// Takes the first word off `text`, with the blanks before it; empty where only blanks are left. Ends of lines are
/// blanks.
std::string_view next_word(std::string_view& text);

/// A text line by line, and each line word by word. The text and the name must outlive it.
class TextLines {
 public:
  /// Before the first line; `name` is the file's, for errors.
  TextLines(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  bool next();                                                           ///< to the next line; false behind the last
  std::string_view word() { return next_word(line_); }                   ///< the line's next word; empty at its end
  std::string_view rest() const { return line_; }                        ///< of the line, behind the words taken so far
  void end_at(char sign) { line_ = line_.substr(0, line_.find(sign)); }  ///< the line ends before a comment's sign
  double coordinate();                                     ///< the next word [m]; fails where it isn't finite
  std::size_t number() const { return number_; }           ///< of the line, from 1; 0 before the first
  std::size_t bytes_left() const { return text_.size(); }  ///< behind this line

  /// Throws InputError "FILE: line N: what", at this line or at another.
  [[noreturn]] void fail(const std::string& what) const { fail_at(number_, what); }
  [[noreturn]] void fail_at(std::size_t number, const std::string& what) const;

 private:
  std::string_view text_, line_;
  const std::string& name_;
  std::size_t number_ = 0;
};

}  // namespace ogc::compare
