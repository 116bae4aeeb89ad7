#include "compare/oracle/box_tree.hpp"

#include <algorithm>
#include <numeric>

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

bool Box::meets(const Box& other) const {
  return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] && other.low[1] <= high[1] &&
         low[2] <= other.high[2] && other.low[2] <= high[2];
}

Box box_of(std::initializer_list<Vec3> points) {
  Box box;
  for (const Vec3& point : points) box.add(point);
  return box;
}

BoxTree::BoxTree(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  std::vector<Index> items(boxes.size());
  std::iota(items.begin(), items.end(), 0);
  nodes_.reserve(2 * boxes.size() - 1);
  build(boxes, items);
}

Index BoxTree::build(std::span<const Box> boxes, std::span<Index> items) {
  const auto number = static_cast<Index>(nodes_.size());
  Node& fresh = nodes_.emplace_back();
  for (const Index i : items) fresh.box.add(boxes[static_cast<std::size_t>(i)]);
  if (items.size() == 1) {
    fresh.item = items[0];
    return number;
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (fresh.box.high[k] - fresh.box.low[k] > fresh.box.high[axis] - fresh.box.low[axis]) axis = k;
  const auto key = [&](Index i) {
    return boxes[static_cast<std::size_t>(i)].low[axis] / 2 + boxes[static_cast<std::size_t>(i)].high[axis] / 2;
  };
  const std::size_t half = items.size() / 2;
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                   [&](Index a, Index b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  const Index left = build(boxes, items.first(half));
  const Index right = build(boxes, items.subspan(half));
  nodes_[static_cast<std::size_t>(number)].left = left;
  nodes_[static_cast<std::size_t>(number)].right = right;
  return number;
}

}  // namespace ogc::compare
