// Compares the sphere query of CGAL's tree with a test of all boxes, in integers small enough for exact doubles, also
// for balls that touch.
#include "reference/definitions/sphere_tree.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/catch.hpp"

using namespace ogc;
using reference::Box;
using reference::Index;

namespace {

/// Returns the squared distance, exact if all numbers are integers below 2²⁵.
double squared_distance(const Box& box, const std::array<double, 3>& x) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = std::max({box.low[k] - x[k], x[k] - box.high[k], 0.0});
    sum += d * d;
  }
  return sum;
}

std::vector<Index> sorted(std::vector<Index> found) {
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

TEST_CASE("sphere_tree: boxes, flat ones, segments and points that a ball meets, touching included, as over all boxes",
          "[property]") {
  std::mt19937 random(31);
  std::uniform_int_distribution<int> coordinate(-12, 12), size(0, 3);
  std::size_t touching = 0;
  for (const int count : {1, 2, 3, 10, 300}) {
    std::vector<Box> boxes(static_cast<std::size_t>(count));
    for (Box& box : boxes) {
      for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = coordinate(random);
        box.high[k] = box.low[k] + std::max(0, size(random) - 1);
      }
    }
    const reference::SphereTree tree(boxes);
    for (int q = 0; q < 200; ++q) {
      const std::array<double, 3> centre{double(coordinate(random)), double(coordinate(random)),
                                         double(coordinate(random))};
      const double square = coordinate(random) + 12;
      std::vector<Index> expected;
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const double d = squared_distance(boxes[i], centre);
        if (d <= square) expected.push_back(static_cast<Index>(i));
        touching += d == square ? 1 : 0;
      }
      CHECK(sorted(tree.within(centre, square)) == expected);
    }
  }
  CHECK(touching > 100);
}

TEST_CASE("sphere_tree: one unit in the last place decides, however far from the origin", "[unit]") {
  for (const double far : {0.0, 1.0, 1048576.0}) {
    const double near = std::nextafter(far + 1, 0.0);
    const std::vector<Box> boxes{{{far + 1, 0, 0}, {far + 1, 0, 0}}, {{near, 0, 0}, {near, 0, 0}}};
    const reference::SphereTree tree(boxes);
    CHECK(sorted(tree.within({far, 0, 0}, 1)) == std::vector<Index>{0, 1});
    CHECK(sorted(tree.within({far, 0, 0}, std::nextafter(1.0, 0.0))) == std::vector<Index>{1});
  }
}

TEST_CASE("sphere_tree: no boxes, nothing found", "[unit]") {
  CHECK(reference::SphereTree({}).within({0, 0, 0}, 1).empty());
}
