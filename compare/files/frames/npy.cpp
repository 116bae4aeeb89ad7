#include "compare/files/frames/npy.hpp"

#include <algorithm>
#include <optional>

#include "compare/files/numbers.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {
namespace {

/// Longest header that is read [bytes]. A shape needs only a few numbers; structured types may need more, but are
/// rejected.
constexpr std::size_t longest_header = 1 << 16;

/// Returns the text after "'key':" in the header's dictionary.
std::string_view value_of(std::string_view header, const std::string& key, const std::string& where) {
  const std::size_t quoted = header.find("'" + key + "'");
  const std::size_t colon = quoted == std::string_view::npos ? quoted : header.find(':', quoted);
  if (colon == std::string_view::npos) throw InputError(where + ": its header has no '" + key + "'; it is damaged");
  header.remove_prefix(colon + 1);
  header.remove_prefix(std::min(header.find_first_not_of(' '), header.size()));
  return header;
}

void parse_type(std::string_view text, const std::string& where, NpyHeader& header) {
  constexpr std::array<std::string_view, 10> names{"i1", "u1", "i2", "u2", "i4",
                                                   "u4", "i8", "u8", "f4", "f8"};  // by ScalarType
  const std::string_view quoted = text.starts_with('\'') ? text.substr(1, text.find('\'', 1) - 1) : text.substr(0, 20);
  const auto found = quoted.size() == 3 ? std::ranges::find(names, quoted.substr(1)) : names.end();
  if (found == names.end())
    throw InputError(where + ": its type is " + std::string(quoted) +
                     "; store whole numbers, float32 or float64 (numpy: array.astype(numpy.float32))");
  header.type = static_cast<ScalarType>(found - names.begin());
  header.order = quoted.front() == '>' ? std::endian::big : std::endian::little;
}

void parse_shape(std::string_view text, const std::string& where, NpyHeader& header) {
  const std::size_t end = text.find(')');
  if (!text.starts_with('(') || end == std::string_view::npos)
    throw InputError(where + ": its shape can't be read; the header is damaged");
  text = text.substr(1, end - 1);
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(" ,"), text.size()));
    if (text.empty()) return;
    const std::string_view word = text.substr(0, text.find_first_of(" ,"));
    if (!parse_number(word, header.shape.emplace_back()))
      throw InputError(where + ": its shape can't be read; the header is damaged");
    text.remove_prefix(word.size());
  }
}

}  // namespace

NpyHeader read_npy_header(const ByteSource& source, const std::string& where) {
  std::array<char, 8> magic;
  source(magic, "the header");
  if (std::string_view(magic.data(), 6) != "\x93NUMPY")
    throw InputError(where + ": does not begin as NumPy's arrays do; it is no .npy array");
  const int version = magic[6];
  if (version < 1 || version > 3)
    throw InputError(where + ": is of .npy version " + std::to_string(version) + "; 1 to 3 are known");
  std::array<char, 4> raw{};
  source(std::span(raw).first(version == 1 ? 2 : 4), "the header");
  const std::size_t length = number_at<std::uint32_t>(raw.data(), std::endian::little);
  if (length > longest_header)
    throw InputError(where + ": its header of " + std::to_string(length) + " bytes is no array's; it is damaged");
  std::string text(length, '\0');
  source(text, "the header");
  NpyHeader header;
  parse_type(value_of(text, "descr", where), where, header);
  const std::string_view order = value_of(text, "fortran_order", where);
  header.fortran_order = order.starts_with("True");
  if (!header.fortran_order && !order.starts_with("False"))
    throw InputError(where + ": whether it is in Fortran order can't be read; the header is damaged");
  parse_shape(value_of(text, "shape", where), where, header);
  return header;
}

std::string shape_text(std::span<const std::uint64_t> shape) {
  std::string text;
  for (const std::uint64_t extent : shape) text += (text.empty() ? "" : ", ") + std::to_string(extent);
  return "[" + text + "]";
}

}  // namespace ogc::compare
