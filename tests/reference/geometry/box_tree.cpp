#include "reference/geometry/box_tree.hpp"

#include <algorithm>
#include <random>

#include "tests/catch.hpp"

using namespace ogc::reference;

/// The numbers of boxes are near the capacity of a leaf, and near the number from which two threads build the tree. The
/// threads rely on node positions that are computed beforehand.
TEST_CASE("the reference's box tree visits each box that meets the query once, and no other, at any number of boxes",
          "[property]") {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> coordinate(0, 40), side(0, 2);
  const auto random_box = [&] {
    Box box;
    for (std::size_t axis = 0; axis < 3; ++axis)
      box.low[axis] = coordinate(random), box.high[axis] = box.low[axis] + side(random);
    return box;
  };
  std::vector<std::size_t> counts{2047, 2048, 2049, 4096, 4097, 9001};
  for (std::size_t count = 0; count < 40; ++count) counts.push_back(count);
  for (const std::size_t count : counts) {
    std::vector<Box> boxes(count);
    std::generate(boxes.begin(), boxes.end(), random_box);
    const BoxTree tree(boxes);
    for (int query = 0; query < 5; ++query) {
      const Box asked = random_box();
      std::vector<Index> expected, found;
      for (std::size_t i = 0; i < count; ++i)
        if (meet(boxes[i], asked)) expected.push_back(static_cast<Index>(i));
      tree.query(asked, [&](Index i) { found.push_back(i); });
      std::sort(found.begin(), found.end());
      CHECK(found == expected);
    }
  }
}
