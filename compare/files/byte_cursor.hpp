// Reads a binary file from its first to its last byte; errors name the file and the byte.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "compare/files/scalars.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {

/// Takes numbers and lines off a file's bytes. The bytes and the name must outlive the cursor.
class ByteCursor {
 public:
  /// Starts at byte `at`. `name` is the file's name in errors.
  ByteCursor(std::string_view bytes, const std::string& name, std::endian order, std::size_t at = 0)
      : bytes_(bytes), name_(name), order_(order), at_(at) {}

  std::size_t at() const { return at_; }                    ///< position of the next byte, from 0
  std::size_t left() const { return bytes_.size() - at_; }  ///< number of bytes left
  std::endian order() const { return order_; }              ///< byte order of numbers
  void skip(std::size_t count) { take(count, "data"); }     ///< skips bytes; fails if the file ends before that

  /// Returns the next number. If the file ends before it, the error calls it `what`.
  template <class Number>
  Number number(const std::string& what) {
    return number_at<Number>(take(sizeof(Number), what).data(), order_);
  }

  /// Returns the next `count` bytes.
  std::string_view take(std::size_t count, const std::string& what) {
    if (count > left())
      throw InputError(name_ + ": ends at byte " + std::to_string(bytes_.size()) + ", where " + what +
                       " should stand: the file is truncated; write it again");
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }

  /// Returns `count`, the announced number of entries of `size` bytes each; fails if the file has fewer bytes left.
  std::size_t counted(double count, std::size_t size, const std::string& what) const {
    if (!(count >= 0 && count <= static_cast<double>(left() / size)))
      fail(shortest(count) + " " + what + " can't stand in the " + std::to_string(left()) +
           " bytes that follow: the file is truncated or damaged");
    return static_cast<std::size_t>(count);
  }

  /// Returns the rest of the line, without its end.
  std::string_view line() {
    const std::string_view found = bytes_.substr(at_, bytes_.substr(at_).find('\n'));
    at_ = std::min(at_ + found.size() + 1, bytes_.size());
    return found.ends_with('\r') ? found.substr(0, found.size() - 1) : found;
  }

  /// Throws InputError "FILE: byte N: what".
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(name_ + ": byte " + std::to_string(at_) + ": " + what);
  }

 private:
  std::string_view bytes_;
  const std::string& name_;
  std::endian order_;
  std::size_t at_;
};

}  // namespace ogc::compare
