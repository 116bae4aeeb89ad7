// A tree of axis-parallel boxes for the oracle's culling. Boxes are closed and compared in double without arithmetic,
// so culling never rounds: a pair that meets is always visited. Own tree, because CGAL's asks its kernel about each
// datum and wants no degenerate ones.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Closed box [low, high] [m]; a new one is empty.
struct Box {
  std::array<double, 3> low{1e308, 1e308, 1e308}, high{-1e308, -1e308, -1e308};  ///< corners [m]
  void add(const Vec3& point);                                                   ///< grows to hold the point
  void add(const Box& box);                                                      ///< grows to hold the box
  bool meets(const Box& other) const;                                            ///< closed boxes
};

/// Box of the given points.
Box box_of(std::initializer_list<Vec3> points);

/// Binary tree over boxes, split at the median centre along the longest side; the same boxes give the same tree.
class BoxTree {
 public:
  explicit BoxTree(std::span<const Box> boxes);

  /// Calls `visit(i)` for every box i that meets `query`, in the order of the tree.
  template <class Visit>
  void for_each_meeting(const Box& query, Visit&& visit) const {
    if (nodes_.empty()) return;
    std::array<Index, 64> stack;  // the median split halves the items, so 2³¹ of them are 32 levels deep
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const Node& node = nodes_[static_cast<std::size_t>(stack[--depth])];
      if (!node.box.meets(query)) continue;
      if (node.item >= 0) {
        visit(node.item);
      } else {
        stack[depth++] = node.right;
        stack[depth++] = node.left;
      }
    }
  }

 private:
  struct Node {
    Box box;
    Index left = -1, right = -1, item = -1;  ///< a leaf holds one item
  };
  Index build(std::span<const Box> boxes, std::span<Index> items);
  std::vector<Node> nodes_;
};

}  // namespace ogc::compare
