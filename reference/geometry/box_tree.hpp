// Finds the primitives whose boxes meet a box. This only preselects pairs: distances and contacts are decided
// elsewhere, exactly.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::reference {

using compare::Index;

/// A closed, axis-parallel box [m]. Empty until the first `include`.
struct Box {
  std::array<double, 3> low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};  ///< corners [m]
};

/// Grows the box until it holds a point.
void include(Box& box, const compare::Vec3f& point);
/// Grows the box until it holds another box.
void include(Box& box, const Box& other);
/// Returns the box, widened on all sides by `distance` [m], up to one rounding of double.
Box widened(Box box, double distance);
/// Returns whether two closed boxes have a point in common.
bool meet(const Box& a, const Box& b);

/// A balanced binary tree over the boxes of numbered primitives.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes);

  /// Calls visit(number) for every primitive whose box meets `query`. The order depends on the tree only.
  template <class Visit>
  void query(const Box& query, Visit visit) const {
    if (nodes_.empty()) return;
    std::array<std::uint32_t, 64> stack{};
    std::size_t size = 1;
    while (size > 0) {
      const Node& node = nodes_[stack[--size]];
      if (!meet(node.box, query)) continue;
      if (node.count == 0) {
        stack[size++] = node.first;
        stack[size++] = node.first + 1;
        continue;
      }
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
        if (meet(boxes_[static_cast<std::size_t>(order_[k])], query)) visit(order_[k]);
      }
    }
  }

 private:
  /// A leaf holds order_[first .. first + count); an inner node (count 0) has the children `first` and `first + 1`.
  struct Node {
    Box box;
    std::uint32_t first = 0, count = 0;
  };
  void build(std::uint32_t node, std::uint32_t free, std::uint32_t first, std::uint32_t count);

  std::vector<Box> boxes_;
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

}  // namespace ogc::reference
