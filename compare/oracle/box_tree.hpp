// Culls pairs with a tree of axis-parallel boxes. Boxes are closed and compared in double without arithmetic. So
// culling never rounds, and every pair that meets is visited. CGAL's own tree evaluates kernel predicates for each item
// and does not allow degenerate items.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Closed box [low, high] [m]; a new box is empty.
struct Box {
  std::array<double, 3> low{1e308, 1e308, 1e308}, high{-1e308, -1e308, -1e308};  ///< corners [m]
  void add(const Vec3& point);                                                   ///< grows to contain the point
  void add(const Box& box);                                                      ///< grows to contain the box
  /// Returns whether the closed boxes share a point. Inline, because it is called most often.
  bool meets(const Box& other) const {
    return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] && other.low[1] <= high[1] &&
           low[2] <= other.high[2] && other.low[2] <= high[2];
  }
};

/// Returns the box of the given points.
Box box_of(std::initializer_list<Vec3> points);

/// Binary tree over boxes, split at the median centre along the longest side. Equal boxes give equal trees on any
/// number of threads.
class BoxTree {
 public:
  explicit BoxTree(std::span<const Box> boxes);
  /// Returns the largest memory needed to make a tree over this many boxes, including the boxes.
  static std::size_t bytes(std::size_t boxes);

  /// Calls `visit(i)` for every box i that meets `query`, in the order of the tree.
  template <class Visit>
  void for_each_meeting(const Box& query, Visit&& visit) const {
    if (nodes_.empty()) return;
    std::array<Index, 64> stack;  // a median split halves the items, so a tree of 2³¹ items has 32 levels
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const Index number = stack[--depth];
      const Node& node = nodes_[static_cast<std::size_t>(number)];
      if (!node.box.meets(query)) continue;
      if (node.item >= 0) {
        visit(node.item);
      } else {
        stack[depth++] = node.right;
        stack[depth++] = number + 1;
      }
    }
  }

 private:
  /// A leaf holds one item. The left child is stored after its parent, the right child after the left child's subtree.
  struct Node {
    Box box;
    Index right = -1, item = -1;
  };
  /// The centre and index of a box, from which a node is split.
  struct Item {
    std::array<double, 3> centre{};
    Index box = 0;
  };
  void build(std::span<const Box> boxes, std::span<Item> items, Index number);
  std::vector<Node> nodes_;
};

}  // namespace ogc::compare
