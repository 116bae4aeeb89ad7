// A median split halves the count at each level. So a stack of 64 entries is enough for any 32-bit number of
// primitives.
#include "reference/geometry/box_tree.hpp"

#include <algorithm>
#include <numeric>

#include <tbb/parallel_invoke.h>

namespace ogc::reference {
namespace {

constexpr std::uint32_t leaf_size = 4;
constexpr std::uint32_t worth_a_thread = 2048;

/// Returns the number of nodes of a tree of `count` primitives, and of a tree of `count + 1` primitives. The children
/// of a node differ by at most one primitive. So the nodes of a level hold k or k + 1 primitives, for one k.
std::array<std::uint32_t, 2> node_counts(std::uint32_t count) {
  if (count + 1 <= leaf_size) return {1, 1};
  const auto halves = node_counts(count / 2);
  const std::uint32_t even = 1 + 2 * halves[0], odd = 1 + halves[0] + halves[1], next = 1 + 2 * halves[1];
  const auto kept = [](std::uint32_t of, std::uint32_t nodes) { return of <= leaf_size ? 1 : nodes; };
  return count % 2 == 0 ? std::array{kept(count, even), kept(count + 1, odd)}
                        : std::array{kept(count, odd), kept(count + 1, next)};
}

double middle(const Box& box, std::size_t axis) { return box.low[axis] + box.high[axis]; }

std::size_t longest_axis(const Box& box) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis]) axis = k;
  }
  return axis;
}

}  // namespace

void include(Box& box, const compare::Vec3f& point) {
  const std::array<double, 3> p{point.x, point.y, point.z};
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = std::min(box.low[k], p[k]);
    box.high[k] = std::max(box.high[k], p[k]);
  }
}

void include(Box& box, const Box& other) {
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = std::min(box.low[k], other.low[k]);
    box.high[k] = std::max(box.high[k], other.high[k]);
  }
}

Box widened(Box box, double distance) {
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] -= distance;
    box.high[k] += distance;
  }
  return box;
}

bool meet(const Box& a, const Box& b) {
  return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] && b.low[1] <= a.high[1] &&
         a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
}

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (boxes_.empty()) return;
  const auto count = static_cast<std::uint32_t>(boxes_.size());
  nodes_.resize(node_counts(count)[0]);
  build(0, 1, 0, count);
}

/// Stores the tree below `node` in the nodes from `free` on: the two children, then the tree below the first child,
/// then the tree below the second.
void BoxTree::build(std::uint32_t node, std::uint32_t free, std::uint32_t first, std::uint32_t count) {
  Box box;
  for (std::uint32_t k = first; k < first + count; ++k) include(box, boxes_[static_cast<std::size_t>(order_[k])]);
  nodes_[node].box = box;
  if (count <= leaf_size) {
    nodes_[node].first = first;
    nodes_[node].count = count;
    return;
  }
  const std::size_t axis = longest_axis(box);
  const std::uint32_t half = count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                   [&](Index a, Index b) {
                     const double x = middle(boxes_[static_cast<std::size_t>(a)], axis),
                                  y = middle(boxes_[static_cast<std::size_t>(b)], axis);
                     return x < y || (x == y && a < b);
                   });
  nodes_[node].first = free;
  const auto left = [&] { build(free, free + 2, first, half); };
  const auto right = [&] { build(free + 1, free + 1 + node_counts(half)[0], first + half, count - half); };
  if (count > worth_a_thread) {
    tbb::parallel_invoke(left, right);
  } else {
    left();
    right();
  }
}

}  // namespace ogc::reference
