// Reads binary files: their keywords and some counts are lines as in the text format, nodes and elements are bytes
// between these lines.
#include <array>
#include <bit>
#include <cmath>

#include "compare/files/byte_cursor.hpp"
#include "compare/files/meshes/msh_collector.hpp"
#include "compare/files/numbers.hpp"

namespace ogc::compare {
namespace {

class BinaryMshParser {
 public:
  BinaryMshParser(std::string_view bytes, const std::string& name, std::size_t begin, bool is_new,
                  std::size_t size_of_count)
      : bytes_(bytes),
        cursor_(bytes, name, order_at(bytes, begin), begin),
        collector_(name, true),
        is_new_(is_new),
        size_of_count_(size_of_count) {}

  PolygonMesh parse() {
    if (integer("the number 1, which tells the order of bytes") != 1)
      cursor_.fail("the number 1, which tells the order of bytes, should stand before this: the file is damaged");
    end_of("$MeshFormat");
    while (cursor_.left() > 0) {
      const std::string keyword(cursor_.line());
      if (keyword.find_first_not_of(" \t\r") == std::string::npos) continue;
      if (keyword == "$Nodes") {
        is_new_ ? nodes_4() : nodes_2();
      } else if (keyword == "$Elements") {
        is_new_ ? elements_4() : elements_2();
      } else if (keyword.starts_with('$')) {
        skip(keyword);
      } else {
        cursor_.fail("what stands before this is no section: the file is damaged");
      }
    }
    return collector_.finish();
  }

 private:
  static std::endian order_at(std::string_view bytes, std::size_t begin) {
    return bytes.substr(begin, 4) == std::string_view("\0\0\0\1", 4) ? std::endian::big : std::endian::little;
  }

  std::int32_t integer(const char* what) { return cursor_.number<std::int32_t>(what); }
  double coordinate() { return cursor_.number<double>("a coordinate"); }

  /// Returns a tag or a count of format 4.1, which has 4 or 8 bytes.
  std::int64_t wide(const char* what) {
    if (size_of_count_ == 4) return cursor_.number<std::uint32_t>(what);
    const auto number = cursor_.number<std::uint64_t>(what);
    return number > std::uint64_t{1} << 62 ? -1 : static_cast<std::int64_t>(number);
  }

  std::size_t count(const char* what, std::size_t size) {
    return cursor_.counted(static_cast<double>(wide(what)), size, what);
  }

  /// Returns a count of format 2.2, which is a line of text.
  std::size_t line_count(const char* what, std::size_t size) {
    const std::string line(cursor_.line());
    double value = -1;
    if (!parse_number(line, value)) cursor_.fail(std::string("a line with ") + what + " should stand before this");
    return cursor_.counted(value, size, what);
  }

  void end_of(const std::string& section) {
    const std::string wanted = "$End" + section.substr(1);
    std::string_view line = cursor_.line();
    if (line.empty() && cursor_.left() > 0) line = cursor_.line();
    if (line != wanted)
      cursor_.fail(wanted + " should stand before this: the file is truncated, or the counts of the section are wrong");
  }

  void skip(const std::string& section) {
    const std::string wanted = "$End" + section.substr(1);
    const std::size_t end = bytes_.find(wanted, cursor_.at());
    if (end == std::string_view::npos)
      cursor_.fail(section + ", which begins before this, does not end: the file is truncated; write it again");
    cursor_.skip(end - cursor_.at());
    cursor_.line();
  }

  void add_node(std::int64_t tag, std::size_t place) {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
      collector_.fail(place,
                      "a coordinate of node " + std::to_string(tag) + " is not finite; give three finite numbers [m]");
    collector_.add_node(tag, place, {x, y, z});
  }

  void nodes_2() {
    const std::size_t nodes = line_count("nodes", 28);
    for (std::size_t i = 0; i < nodes; ++i) {
      const std::size_t place = cursor_.at();
      add_node(integer("the tag of a node"), place);
    }
    end_of("$Nodes");
  }

  void nodes_4() {
    const std::size_t blocks = count("blocks of nodes", 12 + size_of_count_);
    for (const char* what : {"the number of nodes", "the lowest tag", "the highest tag"}) wide(what);
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::int32_t dimension = integer("a dimension");
      integer("an entity");
      const bool is_parametric = integer("0 or 1") != 0;
      if (dimension < 0 || dimension > 3) cursor_.fail("a dimension before this is " + std::to_string(dimension));
      const std::size_t more = is_parametric ? static_cast<std::size_t>(dimension) : 0;
      const std::size_t nodes = count("nodes", size_of_count_ + 8 * (3 + more));
      std::vector<std::int64_t> tags;
      for (std::size_t i = 0; i < nodes; ++i) tags.push_back(wide("the tag of a node"));
      for (const std::int64_t tag : tags) {
        add_node(tag, cursor_.at());
        cursor_.skip(8 * more);
      }
    }
    end_of("$Nodes");
  }

  void elements_2() {
    const std::size_t elements = line_count("elements", 8);
    for (std::size_t done = 0; done < elements;) {
      const std::size_t place = cursor_.at();
      const MshElementType& type = collector_.type_of(integer("the type of elements"), place);
      const std::int32_t here = integer("the number of elements"), tags = integer("the number of tags");
      if (here < 1 || tags < 0 || static_cast<std::size_t>(here) > elements - done)
        cursor_.fail("the number of elements or of their tags before this is wrong: the file is damaged");
      cursor_.counted(tags, 4, "tags");
      cursor_.counted(here, 4 * (1 + static_cast<std::size_t>(tags) + type.nodes), "elements");
      for (std::int32_t i = 0; i < here; ++i) {
        const std::size_t element = cursor_.at();
        const std::int32_t tag = integer("the tag of an element");
        cursor_.skip(4 * static_cast<std::size_t>(tags));
        add_element(type, tag, element, [&] { return std::int64_t{integer("the tag of a node")}; });
      }
      done += static_cast<std::size_t>(here);
    }
    end_of("$Elements");
  }

  void elements_4() {
    const std::size_t blocks = count("blocks of elements", 12 + size_of_count_);
    for (const char* what : {"the number of elements", "the lowest tag", "the highest tag"}) wide(what);
    for (std::size_t b = 0; b < blocks; ++b) {
      integer("a dimension"), integer("an entity");
      const std::size_t place = cursor_.at();
      const MshElementType& type = collector_.type_of(integer("the type of elements"), place);
      const std::size_t elements = count("elements", size_of_count_ * (1 + type.nodes));
      for (std::size_t i = 0; i < elements; ++i) {
        const std::size_t element = cursor_.at();
        const std::int64_t tag = wide("the tag of an element");
        add_element(type, tag, element, [&] { return wide("the tag of a node"); });
      }
    }
    end_of("$Elements");
  }

  template <class Next>
  void add_element(const MshElementType& type, std::int64_t tag, std::size_t place, Next next) {
    std::array<std::int64_t, 4> first{};
    for (std::size_t k = 0; k < type.nodes; ++k) {
      const std::int64_t node = next();
      if (k < first.size()) first[k] = node;
    }
    collector_.add_element(type, tag, place, first);
  }

  std::string_view bytes_;
  ByteCursor cursor_;
  MshCollector collector_;
  bool is_new_;
  std::size_t size_of_count_;
};

}  // namespace

PolygonMesh parse_binary_msh(std::string_view bytes, const std::string& name, std::size_t begin, bool is_new,
                             std::size_t size_of_count) {
  return BinaryMshParser(bytes, name, begin, is_new, size_of_count).parse();
}

}  // namespace ogc::compare
