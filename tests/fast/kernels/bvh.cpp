// Tests the order of the trees. The judge tests whether searches find all that is near; this does not depend on the
// order.
#include "fast/kernels/bvh.hpp"

#include <algorithm>
#include <cstdlib>
#include <random>
#include <utility>
#include <vector>

#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

struct Placed {
  std::uint64_t key;
  Cell cell;
};

/// Returns the cells of a cube in the order of the Hilbert curve.
std::vector<Placed> along_curve(const Cell& corner, std::uint32_t side) {
  std::vector<Placed> cells;
  for (std::uint32_t i = 0; i < side; ++i)
    for (std::uint32_t j = 0; j < side; ++j)
      for (std::uint32_t k = 0; k < side; ++k) {
        const Cell cell{{corner.axis[0] + i, corner.axis[1] + j, corner.axis[2] + k}};
        cells.push_back({hilbert_key(cell), cell});
      }
  std::sort(cells.begin(), cells.end(), [](const Placed& a, const Placed& b) { return a.key < b.key; });
  return cells;
}

std::int64_t distance_1(const Cell& a, const Cell& b) {
  std::int64_t sum = 0;
  for (int k = 0; k < 3; ++k) sum += std::abs(std::int64_t{a.axis[k]} - std::int64_t{b.axis[k]});
  return sum;
}

}  // namespace

TEST_CASE("the curve fills each cube of 2^n cells a side before it leaves it, from cell to touching cell",
          "[property]") {
  std::mt19937 random(1);
  for (const std::uint32_t side : {1U, 2U, 4U, 8U})
    for (int trial = 0; trial < 20; ++trial) {
      Cell corner{};
      for (std::uint32_t& c : corner.axis) c = static_cast<std::uint32_t>(random()) % (1U << 20) / side * side;
      const std::vector<Placed> cells = along_curve(corner, side);
      const std::uint64_t count = cells.size();
      REQUIRE(cells.front().key % count == 0);
      for (std::size_t i = 0; i < cells.size(); ++i) REQUIRE(cells[i].key == cells.front().key + i);
      for (std::size_t i = 1; i < cells.size(); ++i) REQUIRE(distance_1(cells[i - 1].cell, cells[i].cell) == 1);
    }
}

TEST_CASE("the curve begins in the first cell and goes on where a cube of 2^20 / 2 cells a side ends", "[unit]") {
  constexpr std::uint32_t last = (1U << 20) - 1, half = 1U << 19;
  CHECK(hilbert_key({{0, 0, 0}}) == 0);
  std::vector<std::uint64_t> octants;
  for (const std::uint32_t x : {0U, half})
    for (const std::uint32_t y : {0U, half})
      for (const std::uint32_t z : {0U, half}) octants.push_back(hilbert_key({{x, y, z}}) >> 57);
  std::sort(octants.begin(), octants.end());
  for (std::size_t i = 0; i < 8; ++i) CHECK(octants[i] == i);
  std::uint64_t largest = 0;
  for (const std::uint32_t x : {0U, last})
    for (const std::uint32_t y : {0U, last})
      for (const std::uint32_t z : {0U, last}) largest = std::max(largest, hilbert_key({{x, y, z}}));
  CHECK(largest == (std::uint64_t{1} << 60) - 1);  // the curve ends in a corner of the grid
}

TEST_CASE("keys keep vertices, edges and facets apart, and follow the middles of their boxes along the curve",
          "[unit]") {
  const std::vector<Vec> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}};
  const std::vector<EdgeEnds> edges{{0, 1}, {0, 3}};
  std::vector<Facet> facets(1);
  facets[0].corner[0] = 0, facets[0].corner[1] = 1, facets[0].corner[2] = 2;
  SurfaceView surface{};
  surface.vertex_count = 4, surface.edge_count = 2, surface.triangle_count = 1;
  surface.searched_vertices = 4, surface.searched_edges = 2, surface.searched_facets = 1;
  surface.edges = edges.data(), surface.facets = facets.data();
  Quad root;
  Box whole;
  for (const Vec& p : positions) whole.include(p);
  root.child[0] = {whole.lower, 0, whole.upper, -1};
  TreeView tree;
  tree.nodes = &root, tree.levels = 1;
  std::vector<std::uint64_t> keys(7);
  std::vector<int> values(7);
  for (int i = 0; i < 7; ++i) HilbertKeys{surface, positions.data(), tree, tree, keys.data(), values.data()}(i);
  CHECK(values == std::vector<int>{0, 1, 2, 3, 0, 1, 0});
  const auto key_of = [](std::uint64_t kind, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return kind << HilbertKeys::kind_bit | hilbert_key({{x, y, z}});
  };
  constexpr std::uint32_t last = (1U << 20) - 1, half = last / 2;
  CHECK(keys == std::vector<std::uint64_t>{key_of(0, 0, 0, 0), key_of(0, last, 0, 0), key_of(0, 0, last, 0),
                                           key_of(0, last, last, last), key_of(1, half, 0, 0),
                                           key_of(1, half, half, half), key_of(2, half, half, 0)});
  // If only some primitives are searched, keys and values have the order of the list `searched`.
  const std::vector<int> searched{3, 1, 1, 0};
  SurfaceView some = surface;
  some.searched = searched.data(), some.searched_vertices = 2, some.searched_edges = 1;
  std::vector<std::uint64_t> of_some(4);
  std::vector<int> numbers(4);
  for (int i = 0; i < 4; ++i) HilbertKeys{some, positions.data(), tree, tree, of_some.data(), numbers.data()}(i);
  CHECK(numbers == searched);
  CHECK(of_some == std::vector<std::uint64_t>{keys[3], keys[1], keys[5], keys[6]});
  // If the box of the mesh is a point, the key is that of the first cell.
  Quad point;
  Box one;
  one.include(positions[3]);
  point.child[0] = {one.lower, 0, one.upper, -1};
  tree.nodes = &point;
  HilbertKeys{surface, positions.data(), tree, tree, keys.data(), values.data()}(3);
  CHECK(keys[3] == 0);
}
