// The header lists the scalars that follow. A double represents every PLY scalar exactly, so one function reads them
// all; unused scalars are dropped.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "compare/files/meshes/ply.hpp"
#include "compare/files/numbers.hpp"
#include "compare/files/text_lines.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class Format { ascii, little_endian, big_endian };

struct Property {
  std::string name;
  bool is_list = false;
  Scalar count_type = Scalar::uint8, type = Scalar::float32;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Format format = Format::ascii;
  std::vector<Element> elements;
  std::size_t size = 0;   // bytes up to and with end_header
  std::size_t lines = 0;  // lines up to and with end_header
};

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  Header parse() {
    const std::size_t end = bytes_.find_first_of("\r\n");
    if (end != std::string_view::npos && bytes_[end] == '\r' && bytes_.substr(end + 1, 1) != "\n") line_end_ = '\r';
    std::string_view first = next_line();
    if (next_word(first) != "ply") fail("does not begin with 'ply'; it is no PLY file");
    bool has_format = false;
    while (true) {
      std::string_view line = next_line();
      const std::string_view keyword = next_word(line);
      if (keyword == "end_header") break;
      if (keyword == "format") {
        format(line);
        has_format = true;
      } else if (keyword == "element") {
        element(line);
      } else if (keyword == "property") {
        property(line);
      } else if (keyword != "comment" && keyword != "obj_info") {
        fail("'" + shown(keyword) + "' does not belong there");
      }
    }
    if (!has_format) fail("has no 'format' line");
    header_.lines = line_;
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(name_ + ": header line " + std::to_string(line_) + ": " + what);
  }

  std::string_view next_line() {
    ++line_;
    const std::size_t end = bytes_.find(line_end_, header_.size);
    if (end == std::string_view::npos) fail("ends without 'end_header'; the file is truncated or no PLY file");
    const std::string_view line = bytes_.substr(header_.size, end - header_.size);
    header_.size = end + 1;
    return line;
  }

  void format(std::string_view line) {
    const std::string_view format = next_word(line), version = next_word(line);
    if (format == "ascii") {
      header_.format = Format::ascii;
    } else if (format == "binary_little_endian") {
      header_.format = Format::little_endian;
    } else if (format == "binary_big_endian") {
      header_.format = Format::big_endian;
    } else {
      fail("unknown format '" + shown(format) + "'; use ascii, binary_little_endian or binary_big_endian");
    }
    if (version != "1.0") fail("unknown version '" + shown(version) + "'; only 1.0 is known");
  }

  void element(std::string_view line) {
    Element element{std::string(next_word(line)), 0, {}};
    if (!parse_number(next_word(line), element.count)) fail("element '" + element.name + "' has no count");
    if (element.count > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
      fail("element '" + element.name + "' has too many entries");
    if (element.name == "tristrips") fail("triangle strips are not supported; write the mesh with faces");
    header_.elements.push_back(std::move(element));
  }

  void property(std::string_view line) {
    if (header_.elements.empty()) fail("a property before the first element");
    Property property;
    std::string_view type = next_word(line);
    property.is_list = type == "list";
    if (property.is_list) {
      property.count_type = scalar(next_word(line));
      type = next_word(line);
    }
    property.type = scalar(type);
    property.name = next_word(line);
    header_.elements.back().properties.push_back(std::move(property));
  }

  Scalar scalar(std::string_view word) const {
    constexpr std::array<std::string_view, 8> names{"char", "uchar", "short", "ushort",
                                                    "int",  "uint",  "float", "double"};
    constexpr std::array<std::string_view, 8> sized{"int8",  "uint8",  "int16",   "uint16",
                                                    "int32", "uint32", "float32", "float64"};
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (word == names[i] || word == sized[i]) return static_cast<Scalar>(i);
    }
    fail("unknown type '" + shown(word) + "'");
  }

  std::string_view bytes_;
  const std::string& name_;
  char line_end_ = '\n';  ///< last byte of a line
  std::size_t line_ = 0;
  Header header_;
};

// Reads the data after the header, one scalar at a time.
class Scalars {
 public:
  Scalars(std::string_view data, const Header& header) : data_(data), format_(header.format), line_(header.lines + 1) {}

  // Reads the next scalar. Returns false if the data end or, in ascii, the word is no number.
  bool read(Scalar type, double& value) {
    if (format_ == Format::ascii) return parse_number(last_word_ = word(), value);
    switch (type) {
      case Scalar::int8: return read_binary<std::int8_t>(value);
      case Scalar::uint8: return read_binary<std::uint8_t>(value);
      case Scalar::int16: return read_binary<std::int16_t>(value);
      case Scalar::uint16: return read_binary<std::uint16_t>(value);
      case Scalar::int32: return read_binary<std::int32_t>(value);
      case Scalar::uint32: return read_binary<std::uint32_t>(value);
      case Scalar::float32: return read_binary<float>(value);
      case Scalar::float64: return read_binary<double>(value);
    }
    return false;
  }

  std::string_view last_word() const { return last_word_; }  // of ascii
  bool at_end() { return data_.find_first_not_of(" \t\r\n") == std::string_view::npos; }
  std::size_t bytes_left() const { return data_.size(); }
  // Returns the line of the scalar that comes next, in ascii; call it before reading.
  std::size_t next_line() {
    skip_blanks();
    return line_;
  }

 private:
  void skip_blanks() {
    const std::size_t blanks = std::min(data_.find_first_not_of(" \t\r\n\f\v"), data_.size());
    for (std::size_t i = 0; i < blanks; ++i)
      line_ += data_[i] == '\n' || (data_[i] == '\r' && data_.substr(i + 1, 1) != "\n");
    data_.remove_prefix(blanks);
  }

  std::string_view word() {
    skip_blanks();
    return next_word(data_);
  }

  template <class Number>
  bool read_binary(double& value) {
    if (data_.size() < sizeof(Number)) return false;
    std::array<char, sizeof(Number)> raw;
    std::copy_n(data_.begin(), raw.size(), raw.begin());
    data_.remove_prefix(raw.size());
    const bool native = (std::endian::native == std::endian::little) == (format_ == Format::little_endian);
    if (!native) std::reverse(raw.begin(), raw.end());
    value = static_cast<double>(std::bit_cast<Number>(raw));
    return true;
  }

  std::string_view data_, last_word_;
  Format format_;
  std::size_t line_;
};

class BodyParser {
 public:
  BodyParser(const Header& header, std::string_view data, const std::string& name)
      : header_(header), scalars_(data, header), name_(name) {
    mesh_.source.file = name;
  }

  PolygonMesh parse() {
    for (const Element& element : header_.elements) {
      check_properties(element);
      if (element.properties.empty()) continue;
      for (std::size_t i = 0; i < element.count; ++i) entry(element, i);
    }
    if (!has_vertices_) throw InputError(name_ + ": has no element 'vertex'");
    if (!scalars_.at_end())
      throw InputError(name_ + ": " + std::to_string(scalars_.bytes_left()) +
                       " bytes follow the last element; header and data disagree");
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) check("face", f, mesh_.face(f));
    for (std::size_t e = 0; e < mesh_.loose_edges.size(); ++e) check("edge", e, mesh_.loose_edges[e]);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const Element& element, std::size_t i, const std::string& what) const {
    throw InputError(name_ + ": " + element.name + " " + std::to_string(i) + ": " + what);
  }

  void check_properties(const Element& element) {
    const auto require = [&](std::string_view name, bool is_list) {
      for (const Property& p : element.properties) {
        if (p.name == name && p.is_list == is_list) return;
      }
      throw InputError(name_ + ": element '" + element.name + "' has no " + (is_list ? "list " : "") + "property '" +
                       std::string(name) + "'");
    };
    if (element.name == "vertex") {
      for (const char* name : {"x", "y", "z"}) require(name, false);
      has_vertices_ = true;
    } else if (element.name == "edge") {
      for (const char* name : {"vertex1", "vertex2"}) require(name, false);
    } else if (element.name == "face") {
      const auto is_old_name = [](const Property& p) { return p.name == "vertex_index" && p.is_list; };
      if (std::none_of(element.properties.begin(), element.properties.end(), is_old_name))
        require("vertex_indices", true);
    }
  }

  double scalar(const Element& element, std::size_t i, Scalar type) {
    double value = 0;
    if (scalars_.read(type, value)) return value;
    if (header_.format != Format::ascii || scalars_.last_word().empty()) {
      fail(element, i,
           "the file ends here, with " + std::to_string(element.count) + " entries announced; it is truncated");
    }
    fail(element, i, "what stands there is no number: " + no_coordinate(scalars_.last_word()));
  }

  Index index(const Element& element, std::size_t i, double value) const {
    if (value >= 0 && value <= std::numeric_limits<Index>::max() && value == std::floor(value))
      return static_cast<Index>(value);
    fail(element, i, "a vertex index is negative or no whole number");
  }

  void entry(const Element& element, std::size_t i) {
    Vec3 position;
    Edge ends{};
    face_.clear();
    const std::size_t line = header_.format == Format::ascii ? scalars_.next_line() : 0;
    for (const Property& p : element.properties) {
      if (p.is_list) {
        list(element, i, p);
        continue;
      }
      const double value = scalar(element, i, p.type);
      if (p.name == "x") position.x = value;
      if (p.name == "y") position.y = value;
      if (p.name == "z") position.z = value;
      if (element.name == "edge" && p.name == "vertex1") ends[0] = index(element, i, value);
      if (element.name == "edge" && p.name == "vertex2") ends[1] = index(element, i, value);
    }
    if (element.name == "vertex") add_vertex(element, i, position);
    if (element.name == "face") mesh_.add_face(face_);
    if (element.name == "edge") mesh_.loose_edges.push_back({std::min(ends[0], ends[1]), std::max(ends[0], ends[1])});
    if (header_.format == Format::ascii) add_line(element, line);
  }

  void add_line(const Element& element, std::size_t line) {
    if (element.name == "vertex") mesh_.source.vertex_lines.push_back(line);
    if (element.name == "face") mesh_.source.face_lines.push_back(line);
    if (element.name == "edge") mesh_.source.edge_lines.push_back(line);
  }

  void list(const Element& element, std::size_t i, const Property& p) {
    const double count = scalar(element, i, p.count_type);
    if (!(count >= 0)) fail(element, i, "a list of negative length");
    const bool is_face = element.name == "face" && (p.name == "vertex_indices" || p.name == "vertex_index");
    if (is_face && count < 3) fail(element, i, "has " + shortest(count) + " corners; a face has three or more");
    for (std::size_t k = 0; static_cast<double>(k) < count; ++k) {
      const double value = scalar(element, i, p.type);
      if (is_face) face_.push_back(index(element, i, value));
    }
  }

  void add_vertex(const Element& element, std::size_t i, const Vec3& position) {
    if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) {
      fail(element, i, "a coordinate is not finite; give three finite numbers [m]");
    }
    mesh_.positions.push_back(position);
  }

  void check(const char* element, std::size_t i, std::span<const Index> corners) const {
    for (const Index v : corners) {
      if (static_cast<std::size_t>(v) < mesh_.positions.size()) continue;
      throw InputError(name_ + ": " + element + " " + std::to_string(i) + ": vertex " + std::to_string(v) +
                       " does not exist; the file has " + std::to_string(mesh_.positions.size()) + ", numbered from 0");
    }
  }

  const Header& header_;
  Scalars scalars_;
  const std::string& name_;
  PolygonMesh mesh_;
  std::vector<Index> face_;
  bool has_vertices_ = false;
};

}  // namespace

PolygonMesh parse_ply(std::string_view bytes, const std::string& name) {
  const Header header = HeaderParser(bytes, name).parse();
  return BodyParser(header, bytes.substr(header.size), name).parse();
}

}  // namespace ogc::compare
