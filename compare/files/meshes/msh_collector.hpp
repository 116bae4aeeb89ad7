// Makes a mesh of the nodes (given by tag) and the elements (given by type) in a Gmsh file. The readers of the text and
// of the binary formats share it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// One of Gmsh's types of elements.
struct MshElementType {
  int number;             ///< its number in files
  std::size_t nodes;      ///< nodes of an element
  int dimension;          ///< 0 to 3
  std::string_view name;  ///< plural, for messages
};

/// Largest number of nodes of an element type that is read.
inline constexpr std::size_t most_msh_nodes = [] {
  std::size_t most = 0;
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    if constexpr (HasVolume<List>) most = std::max(most, std::tuple_size_v<ElementOf<List>>);
  });
  return most;
}();

/// Collects nodes and elements and makes a mesh of them. A `place` is where an item begins in the file: a line or, in a
/// binary file, a byte.
class MshCollector {
 public:
  /// Starts without nodes. `name` is the file's name and must outlive the collector.
  MshCollector(const std::string& name, bool is_binary);

  /// Returns the type with this number. Throws InputError for unknown types, and for volume elements that are no
  /// tetrahedra of four nodes.
  const MshElementType& type_of(std::int64_t number, std::size_t place) const;
  void add_node(std::int64_t tag, std::size_t place, const Vec3& position);  ///< adds a node
  /// Adds an element. Elements other than tetrahedra are only counted.
  void add_element(const MshElementType& type, std::int64_t tag, std::size_t place,
                   std::span<const std::int64_t> nodes);
  /// Returns the mesh; tetrahedra refer to nodes by their indices in the mesh. Throws InputError if there is no node or
  /// no tetrahedron, or if a tag is repeated, unknown, or not from 1 to 2³¹ − 1.
  PolygonMesh finish();

  /// Throws InputError "FILE: line 7: what", or "byte 7".
  [[noreturn]] void fail(std::size_t place, const std::string& what) const;

 private:
  struct Node {
    std::int64_t tag;
    std::size_t place;
    Vec3 position;
  };
  struct Element {
    int type;
    std::array<std::int64_t, most_msh_nodes> nodes;
    std::int64_t tag;
    std::size_t place;
  };

  template <class List>
  void add_to(const Element& element);
  std::string elements_left_out() const;
  Index file_number(std::int64_t tag, std::size_t place) const;
  void place_nodes();
  Index number_of(std::int64_t tag, std::size_t place) const;

  const std::string& name_;
  bool is_binary_;
  std::vector<Node> nodes_;
  std::vector<Element> elements_;
  std::vector<std::size_t> left_out_;  ///< by type, in the order of the table: number of elements that are left out
  PolygonMesh mesh_;
};

/// Parses a binary file of format 2.2 or 4.1 (`is_new`); `begin` is the byte after the header's line that describes the
/// format. Throws as MshCollector does, and if the file ends too early or its counts are wrong.
PolygonMesh parse_binary_msh(std::string_view bytes, const std::string& name, std::size_t begin, bool is_new,
                             std::size_t size_of_count);

}  // namespace ogc::compare
