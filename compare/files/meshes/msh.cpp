// A file is a sequence of sections, $Name … $EndName, of lines of words. Formats 2.2 and 4.1 both contain nodes by tag
// and elements by type, with counts and tags in different places.
#include "compare/files/meshes/msh.hpp"

#include <array>
#include <cstdint>
#include <vector>

#include "compare/files/meshes/msh_collector.hpp"
#include "compare/files/numbers.hpp"
#include "compare/files/text_lines.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

class MshParser {
 public:
  MshParser(std::string_view text, const std::string& name)
      : text_(text), lines_(text, name), name_(name), collector_(name, false) {}

  PolygonMesh parse() {
    while (lines_.next()) {
      const std::string_view keyword = lines_.word();
      if (keyword.empty()) continue;
      if (keyword == "$MeshFormat") {
        format();
        if (is_binary_)
          return parse_binary_msh(text_, name_, text_.size() - lines_.bytes_left(), is_new_, size_of_count_);
      } else if (keyword == "$NOD" || keyword == "$ELM") {
        lines_.fail("'" + shown(keyword) +
                    "' stands in format 1 of Gmsh, which is not read: write the mesh with gmsh -format msh41");
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
    if (!is_known_) throw InputError(name_ + ": has no $MeshFormat: no mesh of Gmsh, or an empty file");
    return collector_.finish();
  }

 private:
  void end_of(std::string_view section) {
    const std::string wanted = "$End" + std::string(section.substr(1));
    lines_.expect_filled(wanted);
    if (lines_.word() != wanted) lines_.fail("here " + wanted + " should stand: the counts of the section are wrong");
  }

  void skip(std::string_view section) {
    const std::string end = "$End" + std::string(section.substr(1));
    do lines_.expect_filled(end);
    while (lines_.word() != end);
  }

  void format() {
    lines_.expect_filled("the format");
    const std::string_view version = lines_.word();
    const std::int64_t kind = lines_.integer("0 for text or 1 for binary");
    const bool is_second = version == "2" || version == "2.0" || version == "2.1" || version == "2.2";
    if (!is_second && version != "4.1")
      lines_.fail("format " + shown(version) +
                  " is not read, only 2.2 and 4.1: write the mesh with gmsh -format msh41");
    const std::int64_t size = lines_.integer("the size of numbers");
    if (kind != 0 && kind != 1) lines_.fail(std::to_string(kind) + " stands where 0 for text or 1 for binary should");
    is_known_ = true;
    is_new_ = version == "4.1";
    is_binary_ = kind == 1;
    if (size != 8 && (size != 4 || !is_new_))
      lines_.fail("numbers of " + std::to_string(size) + " bytes are not read, only of 8");
    size_of_count_ = static_cast<std::size_t>(size);
    if (is_binary_) return;
    end_of("$MeshFormat");
  }

  void add_node(std::int64_t tag) {
    const double x = lines_.coordinate(), y = lines_.coordinate(), z = lines_.coordinate();
    collector_.add_node(tag, lines_.number(), {x, y, z});
  }

  void nodes_2() {
    lines_.expect_filled("the number of nodes");
    const std::size_t nodes = lines_.count(lines_.word(), "number of nodes");
    for (std::size_t i = 0; i < nodes; ++i) {
      lines_.expect_filled("a node");
      add_node(lines_.integer("the tag of a node"));
    }
    end_of("$Nodes");
  }

  void nodes_4() {
    lines_.expect_filled("the number of blocks of nodes");
    const std::size_t blocks = lines_.count(lines_.word(), "number of blocks");
    for (std::size_t b = 0; b < blocks; ++b) {
      lines_.expect_filled("a block of nodes");
      lines_.integer("a dimension"), lines_.integer("an entity"), lines_.integer("0 or 1");
      const std::size_t nodes = lines_.count(lines_.word(), "number of nodes");
      std::vector<std::int64_t> tags;
      for (std::size_t i = 0; i < nodes; ++i) {
        lines_.expect_filled("the tag of a node");
        tags.push_back(lines_.integer("the tag of a node"));
      }
      for (const std::int64_t tag : tags) {
        lines_.expect_filled("a node");
        add_node(tag);
      }
    }
    end_of("$Nodes");
  }

  void add_element(const MshElementType& type, std::int64_t tag) {
    std::array<std::int64_t, most_msh_nodes> first{};
    for (std::size_t k = 0; k < type.nodes; ++k) {
      const std::int64_t node = lines_.integer("the tag of a node");
      if (k < first.size()) first[k] = node;
    }
    collector_.add_element(type, tag, lines_.number(), first);
  }

  void elements_2() {
    lines_.expect_filled("the number of elements");
    const std::size_t elements = lines_.count(lines_.word(), "number of elements");
    for (std::size_t i = 0; i < elements; ++i) {
      lines_.expect_filled("an element");
      const std::int64_t tag = lines_.integer("the tag of an element");
      const MshElementType& type = collector_.type_of(lines_.integer("the type of an element"), lines_.number());
      const std::int64_t tags = lines_.integer("the number of an element's tags");
      for (std::int64_t k = 0; k < tags; ++k) lines_.integer("a tag");
      add_element(type, tag);
    }
    end_of("$Elements");
  }

  void elements_4() {
    lines_.expect_filled("the number of blocks of elements");
    const std::size_t blocks = lines_.count(lines_.word(), "number of blocks");
    for (std::size_t b = 0; b < blocks; ++b) {
      lines_.expect_filled("a block of elements");
      lines_.integer("a dimension"), lines_.integer("an entity");
      const MshElementType& type = collector_.type_of(lines_.integer("the type of the elements"), lines_.number());
      const std::size_t elements = lines_.count(lines_.word(), "number of elements");
      for (std::size_t i = 0; i < elements; ++i) {
        lines_.expect_filled("an element");
        add_element(type, lines_.integer("the tag of an element"));
      }
    }
    end_of("$Elements");
  }

  std::string_view text_;
  TextLines lines_;
  const std::string& name_;
  MshCollector collector_;
  bool is_known_ = false, is_new_ = false, is_binary_ = false;
  std::size_t size_of_count_ = 8;
};

}  // namespace

PolygonMesh parse_msh(std::string_view text, const std::string& name) { return MshParser(text, name).parse(); }

std::string print_msh(const Mesh& mesh) {
  const std::string nodes = std::to_string(mesh.positions.size());
  std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 " + nodes + " 1 " + nodes + "\n3 1 0 " + nodes +
                     "\n";
  for (std::size_t v = 1; v <= mesh.positions.size(); ++v) text += std::to_string(v) + "\n";
  for (const Vec3& x : mesh.positions) text += shortest(x.x) + " " + shortest(x.y) + " " + shortest(x.z) + "\n";
  std::size_t blocks = 0, tag = 0;
  std::string elements;
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    if constexpr (HasVolume<List>) {
      const auto& all = mesh.*List::list;
      if (all.empty()) return;
      ++blocks;
      elements += "3 1 " + std::to_string(List::msh_type) + " " + std::to_string(all.size()) + "\n";
      for (const auto& element : all) {
        elements += std::to_string(++tag);
        for (const Index v : element) elements += " " + std::to_string(v + 1);
        elements += "\n";
      }
    }
  });
  const std::string count = std::to_string(tag);
  text += "$EndNodes\n$Elements\n" + std::to_string(blocks) + " " + count + " 1 " + count + "\n" + elements;
  return text + "$EndElements\n";
}

}  // namespace ogc::compare
