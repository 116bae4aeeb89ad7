#include "compare/oracle/box_tree.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>

namespace ogc::compare {

void Box::add(const Vec3& point) {
  const std::array<double, 3> p{point.x, point.y, point.z};
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], p[k]);
    high[k] = std::max(high[k], p[k]);
  }
}

void Box::add(const Box& box) {
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], box.low[k]);
    high[k] = std::max(high[k], box.high[k]);
  }
}

Box box_of(std::initializer_list<Vec3> points) {
  Box box;
  for (const Vec3& point : points) box.add(point);
  return box;
}

std::size_t BoxTree::bytes(std::size_t boxes) { return boxes * (sizeof(Box) + sizeof(Item) + 2 * sizeof(Node)); }

BoxTree::BoxTree(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  std::vector<Item> items(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) items[i].centre[k] = boxes[i].low[k] / 2 + boxes[i].high[k] / 2;
    items[i].box = static_cast<Index>(i);
  }
  nodes_.resize(2 * boxes.size() - 1);
  build(boxes, items, 0);
}

void BoxTree::build(std::span<const Box> boxes, std::span<Item> items, Index number) {
  constexpr std::size_t alone = 4096;  // for fewer items a task costs more time than it saves
  Node& node = nodes_[static_cast<std::size_t>(number)];
  if (items.size() == 1) {
    node.item = items[0].box;
    node.box = boxes[static_cast<std::size_t>(node.item)];
    return;
  }
  for (const Item& item : items) node.box.add(boxes[static_cast<std::size_t>(item.box)]);
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (node.box.high[k] - node.box.low[k] > node.box.high[axis] - node.box.low[axis]) axis = k;
  const std::size_t half = items.size() / 2;
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                   [axis](const Item& a, const Item& b) {
                     return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis] : a.box < b.box;
                   });
  node.right = number + static_cast<Index>(2 * half);
  const auto left = [&] { build(boxes, items.first(half), number + 1); };
  const auto right = [&] { build(boxes, items.subspan(half), node.right); };
  if (items.size() > alone)
    tbb::parallel_invoke(left, right);
  else
    left(), right();
}

}  // namespace ogc::compare
