// BVH_SphereQuery of Algorithms 1 and 2 by CGAL's AABB tree. The detections cull with box_tree.hpp; this tree serves
// the independent third computation of the contact sets.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "reference/geometry/box_tree.hpp"

namespace ogc::reference {

/// A tree over the boxes of numbered primitives. A box or a primitive may be flat, a segment or a point.
class SphereTree {
 public:
  explicit SphereTree(std::span<const Box> boxes);
  ~SphereTree();
  SphereTree(const SphereTree&) = delete;
  SphereTree& operator=(const SphereTree&) = delete;

  /// Returns every primitive whose box meets the closed ball, in no particular order. Decided exactly on the given
  /// doubles: rounding loses none.
  std::vector<Index> within(const std::array<double, 3>& centre, double squared_radius) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace ogc::reference
