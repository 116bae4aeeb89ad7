// Implements BVH_SphereQuery of Algorithms 1 and 2 by CGAL's AABB tree. The detections use box_tree.hpp instead, so
// contact sets that are found with this tree can test them.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "reference/geometry/box_tree.hpp"

namespace ogc::reference {

/// A tree over the boxes of numbered primitives. A box may be flat, a segment or a point.
class SphereTree {
 public:
  explicit SphereTree(std::span<const Box> boxes);
  ~SphereTree();
  SphereTree(const SphereTree&) = delete;
  SphereTree& operator=(const SphereTree&) = delete;

  /// Returns every primitive whose box meets the closed ball, in no particular order. Decides exactly on the given
  /// doubles.
  std::vector<Index> within(const std::array<double, 3>& centre, double squared_radius) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace ogc::reference
