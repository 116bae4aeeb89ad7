// Base64 comes in groups of four characters, and padding ends an encoded text. A header and its data may be encoded
// together, or separately with padding between them. VTK encodes them separately only for compressed data; other
// writers always do. Decoding continues after padding, so it reads both cases in the same way.
#include "compare/files/meshes/vtk_arrays.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "compare/files/base64.hpp"
#include "compare/files/inflate.hpp"
#include "compare/files/numbers.hpp"
#include "compare/files/scalars.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

constexpr std::array<std::string_view, 10> type_names{"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                                      "UInt32", "Int64", "UInt64", "Float32", "Float64"};
constexpr std::string_view blanks = " \t\r\n\f\v";

std::string value_in(const XmlAttributes& attributes, const char* key) {
  const auto found = attributes.find(key);
  return found == attributes.end() ? "" : found->second;
}

/// Reads the bytes of an array in their order, base64 or raw. Throws InputError if the file announces more than it has.
class Bytes {
 public:
  Bytes(std::string_view data, bool base64, std::string where)
      : data_(data), base64_(base64), where_(std::move(where)) {}

  std::string take(std::size_t count) {
    // Each four characters give at most three bytes.
    const std::size_t left = base64_ ? data_.size() / 4 * 3 + 3 + ready_.size() : data_.size();
    if (count > left) ends(count);
    if (!base64_) {
      std::string bytes(data_.substr(0, count));
      data_.remove_prefix(count);
      taken_ += count;
      return bytes;
    }
    std::string bytes = std::move(ready_);
    while (bytes.size() < count && decode_base64_group(data_, bytes, where_)) {}
    if (bytes.size() < count) ends(count);
    ready_ = bytes.substr(count);
    bytes.resize(count);
    taken_ += count;
    return bytes;
  }

 private:
  [[noreturn]] void ends(std::size_t count) const {
    throw InputError(where_ + ": ends before byte " + std::to_string(taken_) + " + " + std::to_string(count) +
                     " of its data; the file is truncated");
  }

  std::string_view data_;
  bool base64_;
  std::string where_, ready_;  ///< ready: decoded, not yet taken
  std::size_t taken_ = 0;
};

class ArrayReader {
 public:
  ArrayReader(const VtkDocument& document, const VtkArray& array, const std::string& name)
      : document_(document),
        array_(array),
        where_(name + ": line " + std::to_string(array.line) + ": array '" + value_in(array.attributes, "Name") +
               "' of " + array.section) {}

  std::vector<double> read() const {
    const ScalarType type = scalar_type();
    const std::string format = value_in(array_.attributes, "format");
    if (format == "ascii" || format.empty()) return text();
    if (format != "binary" && format != "appended")
      throw InputError(where_ + ": unknown format '" + format + "'; use ascii, binary or appended");
    Bytes source = format == "binary" ? Bytes(array_.text, true, where_) : appended();
    const std::string bytes = value_in(document_.file, "compressor").empty() ? stored(source) : unpacked(source);
    const std::size_t width = size_of(type);
    if (bytes.size() % width != 0)
      throw InputError(where_ + ": " + std::to_string(bytes.size()) +
                       " bytes are no whole number of values; the file is damaged");
    std::vector<double> values(bytes.size() / width);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = scalar_at(bytes.data() + i * width, type, order());
    return values;
  }

 private:
  ScalarType scalar_type() const {
    const std::string type = value_in(array_.attributes, "type");
    const auto found = std::ranges::find(type_names, type);
    if (found == type_names.end()) throw InputError(where_ + ": " + unknown_name("type", type, type_names));
    return static_cast<ScalarType>(found - type_names.begin());
  }

  std::endian order() const {
    return value_in(document_.file, "byte_order") == "BigEndian" ? std::endian::big : std::endian::little;
  }

  std::vector<double> text() const {
    std::vector<double> values;
    std::string_view rest = array_.text;
    while (true) {
      rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
      if (rest.empty()) return values;
      const std::string_view word = rest.substr(0, rest.find_first_of(blanks));
      rest.remove_prefix(word.size());
      if (!parse_number(word, values.emplace_back()))
        throw InputError(where_ + ": value " + std::to_string(values.size() - 1) + ", '" +
                         std::string(word.substr(0, 40)) + "', is no number");
    }
  }

  Bytes appended() const {
    const bool base64 = document_.encoding == "base64";
    if (!base64 && document_.encoding != "raw")
      throw InputError(where_ + ": appended data are " +
                       (document_.encoding.empty() ? "missing" : "of unknown encoding"));
    std::size_t offset = 0;
    if (!parse_number(value_in(array_.attributes, "offset"), offset) || offset > document_.appended.size())
      throw InputError(where_ + ": its offset '" + value_in(array_.attributes, "offset") +
                       "' lies beyond the appended data, " + std::to_string(document_.appended.size()) +
                       " bytes; the file is truncated");
    return {document_.appended.substr(offset), base64, where_};
  }

  std::size_t header_word(Bytes& source) const {
    const bool wide = value_in(document_.file, "header_type") == "UInt64";
    const std::string bytes = source.take(wide ? 8 : 4);
    return wide ? number_at<std::uint64_t>(bytes.data(), order()) : number_at<std::uint32_t>(bytes.data(), order());
  }

  std::string stored(Bytes& source) const { return source.take(header_word(source)); }

  /// Reads the number of blocks, the size of a block, the size of the last block (0: the same) and the compressed size
  /// of each block; then the blocks.
  std::string unpacked(Bytes& source) const {
    if (const std::string compressor = value_in(document_.file, "compressor"); compressor != "vtkZLibDataCompressor")
      throw InputError(where_ + ": compressed by " + compressor +
                       ", which is not read; write the file with zlib or without compression");
    const std::size_t blocks = header_word(source), size = header_word(source), last = header_word(source);
    std::vector<std::size_t> packed;
    for (std::size_t i = 0; i < blocks; ++i) packed.push_back(header_word(source));
    std::string bytes;
    for (std::size_t i = 0; i < blocks; ++i)
      bytes += inflate(source.take(packed[i]), i + 1 == blocks && last != 0 ? last : size,
                       where_ + ", block " + std::to_string(i));
    return bytes;
  }

  const VtkDocument& document_;
  const VtkArray& array_;
  std::string where_;
};

}  // namespace

std::vector<double> read_vtk_array(const VtkDocument& document, const VtkArray& array, const std::string& name) {
  return ArrayReader(document, array, name).read();
}

}  // namespace ogc::compare
