// A file is a sequence of sections, $Name … $EndName, of lines of words. Both formats give the same two lists, nodes by
// tag and elements by type; they differ in where counts and tags stand.
#include "compare/files/meshes/msh.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "compare/files/meshes/text_lines.hpp"
#include "compare/files/numbers.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

/// What Gmsh calls an element, and how many nodes it has.
struct ElementType {
  int number;
  std::size_t nodes;
  int dimension;
  std::string_view name;
};

constexpr std::array<ElementType, 13> element_types{{{1, 2, 1, "lines"},
                                                     {2, 3, 2, "triangles"},
                                                     {3, 4, 2, "quadrangles"},
                                                     {4, 4, 3, "tetrahedra"},
                                                     {5, 8, 3, "hexahedra"},
                                                     {6, 6, 3, "prisms"},
                                                     {7, 5, 3, "pyramids"},
                                                     {8, 3, 1, "lines of second order"},
                                                     {9, 6, 2, "triangles of second order"},
                                                     {10, 9, 2, "quadrangles of second order"},
                                                     {11, 10, 3, "tetrahedra of second order"},
                                                     {15, 1, 0, "points"},
                                                     {16, 8, 2, "quadrangles of second order"}}};
constexpr int tetrahedron_type = 4;

class MshParser {
 public:
  MshParser(std::string_view text, const std::string& name) : lines_(text, name), name_(name) {
    mesh_.source.file = name;
    mesh_.source.first = 1;
  }

  PolygonMesh parse() {
    while (lines_.next()) {
      const std::string_view keyword = lines_.word();
      if (keyword.empty()) continue;
      if (keyword == "$MeshFormat") {
        format();
      } else if (!is_known_) {
        lines_.fail("'" + shown(keyword) +
                    "' stands before $MeshFormat: no mesh of Gmsh; write one with gmsh -format msh41");
      } else if (keyword == "$Nodes") {
        is_new_ ? nodes_4() : nodes_2();
      } else if (keyword == "$Elements") {
        is_new_ ? elements_4() : elements_2();
      } else if (keyword.starts_with('$')) {
        skip(keyword);
      } else {
        lines_.fail("'" + shown(keyword) + "' stands outside any section");
      }
    }
    return finish();
  }

 private:
  struct Node {
    std::int64_t tag;
    std::size_t line;
    Vec3 position;
  };
  struct Element {
    std::array<std::int64_t, 4> nodes;
    std::int64_t tag;
    std::size_t line;
  };

  /// The next line of a section, which must be there.
  void expect_line(const char* what) {
    if (!lines_.next())
      throw InputError(name_ + ": ends after line " + std::to_string(lines_.number()) + ", where " + what +
                       " should stand: the file is truncated; write it again");
  }

  std::int64_t integer(const char* what) {
    const std::string_view word = lines_.word();
    std::int64_t value = 0;
    if (!parse_number(word, value))
      lines_.fail("'" + shown(word) + "' is no whole number: " + what + " should stand there");
    return value;
  }

  /// No section can have more entries than bytes are left.
  std::size_t count(const char* what) {
    const std::int64_t value = integer(what);
    if (value < 0 || static_cast<std::uint64_t>(value) > lines_.bytes_left())
      lines_.fail(std::to_string(value) + " is no possible " + what + ": the file is truncated or damaged");
    return static_cast<std::size_t>(value);
  }

  void end_of(std::string_view section) {
    const std::string wanted = "$End" + std::string(section.substr(1));
    do expect_line(wanted.c_str());
    while (lines_.rest().find_first_not_of(" \t\r") == std::string_view::npos);
    if (lines_.word() != wanted) lines_.fail("here " + wanted + " should stand: the counts of the section are wrong");
  }

  void skip(std::string_view section) {
    const std::string end = "$End" + std::string(section.substr(1));
    do expect_line(end.c_str());
    while (lines_.word() != end);
  }

  void format() {
    expect_line("the format");
    const std::string_view version = lines_.word();
    const std::int64_t kind = integer("0 for text or 1 for binary");
    if (version != "2.2" && version != "4.1")
      lines_.fail("format " + shown(version) +
                  " is not read, only 2.2 and 4.1: write the mesh with gmsh -format msh41");
    if (kind != 0) lines_.fail("the file is binary: write it as text, without gmsh's -bin");
    is_known_ = true;
    is_new_ = version == "4.1";
    end_of("$MeshFormat");
  }

  void add_node(std::int64_t tag) {
    const double x = lines_.coordinate(), y = lines_.coordinate(), z = lines_.coordinate();
    nodes_.push_back({tag, lines_.number(), {x, y, z}});
  }

  void nodes_2() {
    expect_line("the number of nodes");
    const std::size_t nodes = count("number of nodes");
    for (std::size_t i = 0; i < nodes; ++i) {
      expect_line("a node");
      add_node(integer("the tag of a node"));
    }
    end_of("$Nodes");
  }

  void nodes_4() {
    expect_line("the number of blocks of nodes");
    const std::size_t blocks = count("number of blocks");
    for (std::size_t b = 0; b < blocks; ++b) {
      expect_line("a block of nodes");
      integer("a dimension"), integer("an entity"), integer("0 or 1");
      const std::size_t nodes = count("number of nodes");
      std::vector<std::int64_t> tags;
      for (std::size_t i = 0; i < nodes; ++i) {
        expect_line("the tag of a node");
        tags.push_back(integer("the tag of a node"));
      }
      for (const std::int64_t tag : tags) {
        expect_line("a node");
        add_node(tag);
      }
    }
    end_of("$Nodes");
  }

  const ElementType& type_of(std::int64_t number) const {
    const auto type = std::ranges::find(element_types, number, &ElementType::number);
    if (type == element_types.end())
      lines_.fail("elements of type " + std::to_string(number) +
                  " are not read; mesh the volume with tetrahedra of 4 nodes");
    if (type->dimension == 3 && type->number != tetrahedron_type)
      lines_.fail(std::string(type->name) +
                  " are not read; mesh the volume with tetrahedra of 4 nodes (gmsh -3 -order 1)");
    return *type;
  }

  void add_element(const ElementType& type, std::int64_t tag) {
    if (type.number != tetrahedron_type) {
      ++left_out_[static_cast<std::size_t>(&type - element_types.data())];
      for (std::size_t k = 0; k < type.nodes; ++k) integer("the tag of a node");
      return;
    }
    Element element{{}, tag, lines_.number()};
    for (std::int64_t& node : element.nodes) node = integer("the tag of a node");
    elements_.push_back(element);
  }

  void elements_2() {
    expect_line("the number of elements");
    const std::size_t elements = count("number of elements");
    for (std::size_t i = 0; i < elements; ++i) {
      expect_line("an element");
      const std::int64_t tag = integer("the tag of an element");
      const ElementType& type = type_of(integer("the type of an element"));
      const std::int64_t tags = integer("the number of an element's tags");
      for (std::int64_t k = 0; k < tags; ++k) integer("a tag");
      add_element(type, tag);
    }
    end_of("$Elements");
  }

  void elements_4() {
    expect_line("the number of blocks of elements");
    const std::size_t blocks = count("number of blocks");
    for (std::size_t b = 0; b < blocks; ++b) {
      expect_line("a block of elements");
      integer("a dimension"), integer("an entity");
      const ElementType& type = type_of(integer("the type of the elements"));
      const std::size_t elements = count("number of elements");
      for (std::size_t i = 0; i < elements; ++i) {
        expect_line("an element");
        add_element(type, integer("the tag of an element"));
      }
    }
    end_of("$Elements");
  }

  PolygonMesh finish() {
    if (!is_known_) throw InputError(name_ + ": has no $MeshFormat: no mesh of Gmsh, or an empty file");
    if (nodes_.empty()) throw InputError(name_ + ": has no nodes: the section $Nodes is missing or empty");
    if (elements_.empty())
      throw InputError(name_ + ": has " + elements_left_out() +
                       " and no tetrahedron: mesh the volume (gmsh -3), or give a surface as .obj or .ply");
    place_nodes();
    for (const Element& element : elements_) {
      Tetrahedron corners{};
      for (std::size_t k = 0; k < 4; ++k) corners[k] = number_of(element.nodes[k], element.line);
      mesh_.tetrahedra.push_back(corners);
      mesh_.source.tetrahedra.push_back(file_number(element.tag, element.line));
      mesh_.source.tetrahedron_lines.push_back(element.line);
    }
    if (const std::string others = elements_left_out(); others != "nothing")
      mesh_.notes.push_back(name_ + ": " + others + " were left out: the surface is the boundary of the tetrahedra");
    return std::move(mesh_);
  }

  std::string elements_left_out() const {
    std::string text;
    for (std::size_t i = 0; i < element_types.size(); ++i) {
      if (left_out_[i] == 0) continue;
      text += (text.empty() ? "" : ", ") + std::to_string(left_out_[i]) + " " + std::string(element_types[i].name);
    }
    return text.empty() ? "nothing" : text;
  }

  /// A tag as messages count, from 0.
  Index file_number(std::int64_t tag, std::size_t line) const {
    if (tag < 1 || tag > std::numeric_limits<Index>::max())
      lines_.fail_at(line, "tag " + std::to_string(tag) + " is not from 1 to 2³¹ − 1");
    return static_cast<Index>(tag - 1);
  }

  void place_nodes() {
    std::ranges::stable_sort(nodes_, {}, &Node::tag);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Node& node = nodes_[i];
      if (i > 0 && node.tag == nodes_[i - 1].tag)
        lines_.fail_at(node.line, "node " + std::to_string(node.tag) + " stands in line " +
                                      std::to_string(nodes_[i - 1].line) + " already");
      mesh_.positions.push_back(node.position);
      mesh_.source.vertices.push_back(file_number(node.tag, node.line));
    }
    if (nodes_.back().tag != std::ssize(nodes_)) return;
    mesh_.source.vertices.clear();  // the file counts as the mesh does
    for (const Node& node : nodes_) mesh_.source.vertex_lines.push_back(node.line);
  }

  Index number_of(std::int64_t tag, std::size_t line) const {
    const auto node = std::ranges::lower_bound(nodes_, tag, {}, &Node::tag);
    if (node == nodes_.end() || node->tag != tag)
      lines_.fail_at(line, "node " + std::to_string(tag) + " does not exist");
    return static_cast<Index>(node - nodes_.begin());
  }

  TextLines lines_;
  const std::string& name_;
  bool is_known_ = false, is_new_ = false;
  std::vector<Node> nodes_;
  std::vector<Element> elements_;
  std::array<std::size_t, element_types.size()> left_out_{};
  PolygonMesh mesh_;
};

}  // namespace

PolygonMesh parse_msh(std::string_view text, const std::string& name) { return MshParser(text, name).parse(); }

std::string print_msh(const Mesh& mesh) {
  const std::string nodes = std::to_string(mesh.positions.size()), elements = std::to_string(mesh.tetrahedra.size());
  std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 " + nodes + " 1 " + nodes + "\n3 1 0 " + nodes +
                     "\n";
  for (std::size_t v = 1; v <= mesh.positions.size(); ++v) text += std::to_string(v) + "\n";
  for (const Vec3& x : mesh.positions) text += shortest(x.x) + " " + shortest(x.y) + " " + shortest(x.z) + "\n";
  text += "$EndNodes\n$Elements\n1 " + elements + " 1 " + elements + "\n3 1 " + std::to_string(tetrahedron_type) + " " +
          elements + "\n";
  std::size_t tag = 0;
  for (const Tetrahedron& t : mesh.tetrahedra) {
    text += std::to_string(++tag);
    for (const Index v : t) text += " " + std::to_string(v + 1);
    text += "\n";
  }
  return text + "$EndElements\n";
}

}  // namespace ogc::compare
