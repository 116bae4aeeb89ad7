// Tags of nodes may have any order and gaps, and elements may come before their nodes, so everything is sorted at the
// end.
#include "compare/files/meshes/msh_collector.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "compare/problem/error.hpp"

namespace ogc::compare {
namespace {

constexpr std::array<MshElementType, 13> element_types{{{1, 2, 1, "lines"},
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

/// Returns whether elements of the Gmsh type `number` are read.
bool is_read(int number) {
  bool read = false;
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    if constexpr (HasVolume<List>) read = read || number == List::msh_type;
  });
  return read;
}

}  // namespace

MshCollector::MshCollector(const std::string& name, bool is_binary)
    : name_(name), is_binary_(is_binary), left_out_(element_types.size()) {
  mesh_.source.file = name;
  mesh_.source.first = 1;
}

void MshCollector::fail(std::size_t place, const std::string& what) const {
  throw InputError(name_ + ": " + (is_binary_ ? "byte " : "line ") + std::to_string(place) + ": " + what);
}

const MshElementType& MshCollector::type_of(std::int64_t number, std::size_t place) const {
  const auto type = std::ranges::find(element_types, number, &MshElementType::number);
  if (type == element_types.end())
    fail(place,
         "elements of type " + std::to_string(number) + " are not read; mesh the volume with tetrahedra of 4 nodes");
  if (type->dimension == 3 && !is_read(type->number))
    fail(place,
         std::string(type->name) + " are not read; mesh the volume with tetrahedra of 4 nodes (gmsh -3 -order 1)");
  return *type;
}

void MshCollector::add_node(std::int64_t tag, std::size_t place, const Vec3& position) {
  nodes_.push_back({tag, place, position});
}

void MshCollector::add_element(const MshElementType& type, std::int64_t tag, std::size_t place,
                               std::span<const std::int64_t> nodes) {
  if (!is_read(type.number)) {
    ++left_out_[static_cast<std::size_t>(&type - element_types.data())];
    return;
  }
  Element& element = elements_.emplace_back(Element{type.number, {}, tag, place});
  std::copy_n(nodes.begin(), type.nodes, element.nodes.begin());
}

PolygonMesh MshCollector::finish() {
  if (nodes_.empty()) throw InputError(name_ + ": has no nodes: the section $Nodes is missing or empty");
  if (elements_.empty())
    throw InputError(name_ + ": has " + elements_left_out() +
                     " and no tetrahedron: mesh the volume (gmsh -3), or give a surface as .obj or .ply");
  place_nodes();
  for (const Element& element : elements_)
    for_each_of<MeshLists>([&]<class List, std::size_t>() {
      if constexpr (HasVolume<List>)
        if (element.type == List::msh_type) add_to<List>(element);
    });
  if (const std::string others = elements_left_out(); others != "nothing")
    mesh_.notes.push_back(name_ + ": " + others + " were left out: the surface is the boundary of the tetrahedra");
  return std::move(mesh_);
}

template <class List>
void MshCollector::add_to(const Element& element) {
  ElementOf<List> corners{};
  for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = number_of(element.nodes[k], element.place);
  (mesh_.*List::list).push_back(corners);
  if constexpr (requires { List::numbers; }) {
    (mesh_.source.*List::numbers).push_back(file_number(element.tag, element.place));
    if (!is_binary_) (mesh_.source.*List::lines).push_back(element.place);
  }
}

std::string MshCollector::elements_left_out() const {
  std::string text;
  for (std::size_t i = 0; i < element_types.size(); ++i) {
    if (left_out_[i] == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(left_out_[i]) + " " + std::string(element_types[i].name);
  }
  return text.empty() ? "nothing" : text;
}

/// Converts a tag, which counts from 1, to an index of MeshSource, which counts from 0. Throws InputError if the tag is
/// not from 1 to 2³¹ − 1.
Index MshCollector::file_number(std::int64_t tag, std::size_t place) const {
  if (tag < 1 || tag > std::numeric_limits<Index>::max())
    fail(place, "tag " + std::to_string(tag) + " is not from 1 to 2³¹ − 1");
  return static_cast<Index>(tag - 1);
}

void MshCollector::place_nodes() {
  std::ranges::stable_sort(nodes_, {}, &Node::tag);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (i > 0 && node.tag == nodes_[i - 1].tag)
      fail(node.place, "node " + std::to_string(node.tag) + " stands in " + (is_binary_ ? "byte " : "line ") +
                           std::to_string(nodes_[i - 1].place) + " already");
    mesh_.positions.push_back(node.position);
    mesh_.source.vertices.push_back(file_number(node.tag, node.place));
  }
  if (nodes_.back().tag != std::ssize(nodes_)) return;
  mesh_.source.vertices.clear();  // the file and the mesh number vertices equally
  if (is_binary_) return;
  for (const Node& node : nodes_) mesh_.source.vertex_lines.push_back(node.place);
}

Index MshCollector::number_of(std::int64_t tag, std::size_t place) const {
  const auto node = std::ranges::lower_bound(nodes_, tag, {}, &Node::tag);
  if (node == nodes_.end() || node->tag != tag) fail(place, "node " + std::to_string(tag) + " does not exist");
  return static_cast<Index>(node - nodes_.begin());
}

}  // namespace ogc::compare
