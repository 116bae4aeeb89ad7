#include "compare/oracle/box_tree.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <random>

#include "tests/catch.hpp"

using namespace ogc::compare;

namespace {

std::vector<Box> random_boxes(std::mt19937& random, std::size_t count) {
  std::uniform_int_distribution<int> coordinate(0, 20), side(0, 3);  // with integers boxes often touch
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 low{double(coordinate(random)), double(coordinate(random)), double(coordinate(random))};
    boxes.push_back(box_of({low, {low.x + side(random), low.y + side(random), low.z + side(random)}}));
  }
  return boxes;
}

std::vector<Index> meeting(const BoxTree& tree, const Box& query) {
  std::vector<Index> found;
  tree.for_each_meeting(query, [&](Index i) { found.push_back(i); });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

TEST_CASE("a box tree visits each box that meets the query once, and no other", "[property]") {
  std::mt19937 random(3);
  for (const std::size_t count : {0, 1, 2, 3, 5, 10, 50, 1000, 20'000}) {  // several tasks build the last tree
    const std::vector<Box> boxes = random_boxes(random, count);
    const BoxTree tree(boxes);
    for (const Box& query : random_boxes(random, 100)) {
      std::vector<Index> expected;
      for (std::size_t i = 0; i < count; ++i)
        if (boxes[i].meets(query)) expected.push_back(static_cast<Index>(i));
      CHECK(meeting(tree, query) == expected);
    }
  }
}

TEST_CASE("boxes are closed: a shared corner meets, a gap of one unit in the last place does not", "[unit]") {
  const Box unit = box_of({{0, 0, 0}, {1, 1, 1}});
  CHECK(unit.meets(box_of({{1, 1, 1}, {2, 2, 2}})));
  CHECK(unit.meets(box_of({{0.5, 0.5, 0.5}})));
  CHECK_FALSE(unit.meets(box_of({{1 + 0x1p-52, 0, 0}, {2, 2, 2}})));
  CHECK_FALSE(Box{}.meets(unit));
}

TEST_CASE("a tree over many equal boxes is built and finds all of them", "[unit]") {
  const std::vector<Box> boxes(5000, box_of({{1, 1, 1}}));
  CHECK(meeting(BoxTree(boxes), boxes[0]).size() == boxes.size());
}

TEST_CASE("one thread and several build the same tree: boxes are visited in the same order", "[property]") {
  std::mt19937 random(4);
  const std::vector<Box> boxes = random_boxes(random, 50'000);
  const auto order = [](const BoxTree& tree) {
    std::vector<Index> visited;
    tree.for_each_meeting(box_of({{-1, -1, -1}, {30, 30, 30}}), [&](Index i) { visited.push_back(i); });
    return visited;
  };
  const std::vector<Index> together = order(BoxTree(boxes));
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  CHECK(together.size() == boxes.size());
  CHECK(order(BoxTree(boxes)) == together);
}
