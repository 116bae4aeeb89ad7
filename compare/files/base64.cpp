#include "compare/files/base64.hpp"

#include <algorithm>

#include "compare/problem/error.hpp"

namespace ogc::compare {
namespace {

int digit(char c) {
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t digit = alphabet.find(c);
  return digit == std::string_view::npos ? -1 : static_cast<int>(digit);
}

}  // namespace

bool decode_base64_group(std::string_view& text, std::string& bytes, const std::string& where) {
  unsigned value = 0;
  int digits = 0, padding = 0;
  while (digits + padding < 4) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n\f\v"), text.size()));
    if (text.empty() || text.front() == '<') return false;
    const char c = text.front();
    const int number = digit(c);
    if (number < 0 && c != '=')
      throw InputError(where + ": '" + c + "' is no character of base64; the file is damaged");
    text.remove_prefix(1);
    number < 0 ? ++padding : ++digits;
    value = value << 6 | static_cast<unsigned>(std::max(number, 0));
  }
  for (int k = 0; k < 3 - padding; ++k) bytes.push_back(static_cast<char>(value >> (16 - 8 * k) & 0xff));
  return true;
}

std::string decode_base64(std::string_view text, const std::string& where) {
  std::string bytes;
  while (decode_base64_group(text, bytes, where)) {}
  return bytes;
}

}  // namespace ogc::compare
