// Stores boxes in the tree instead of triangles, because CGAL's tree requires primitives that are not degenerate. No
// step of a query rounds: splitting compares coordinates, and the test of a ball against a box is a filtered exact
// predicate.
#include "reference/definitions/sphere_tree.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <iterator>

namespace ogc::reference {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// A primitive in CGAL's sense: a number, its box, and one point of the box.
struct NumberedBox {
  using Id = Index;
  using Point = Kernel::Point_3;
  using Datum = Kernel::Iso_cuboid_3;
  using Point_reference = Point;
  using Datum_reference = const Datum&;

  NumberedBox(Index index, const Box& box)
      : number(index),
        cuboid(Point(box.low[0], box.low[1], box.low[2]), Point(box.high[0], box.high[1], box.high[2])) {}
  Id id() const { return number; }
  Datum_reference datum() const { return cuboid; }
  Point_reference reference_point() const { return (cuboid.min)(); }

  Index number;
  Datum cuboid;
};

}  // namespace

struct SphereTree::Tree : CGAL::AABB_tree<CGAL::AABB_traits<Kernel, NumberedBox>> {};

SphereTree::SphereTree(std::span<const Box> boxes) : tree_(std::make_unique<Tree>()) {
  for (std::size_t i = 0; i < boxes.size(); ++i) tree_->insert(NumberedBox(static_cast<Index>(i), boxes[i]));
  // Builds the tree here, because the first query would build it otherwise, and queries may run concurrently.
  if (!boxes.empty()) tree_->build();
}

SphereTree::~SphereTree() = default;

std::vector<Index> SphereTree::within(const std::array<double, 3>& centre, double squared_radius) const {
  std::vector<Index> found;
  if (tree_->empty()) return found;
  tree_->all_intersected_primitives(Kernel::Sphere_3(Kernel::Point_3(centre[0], centre[1], centre[2]), squared_radius),
                                    std::back_inserter(found));
  return found;
}

}  // namespace ogc::reference
