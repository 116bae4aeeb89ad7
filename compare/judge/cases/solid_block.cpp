#include "compare/judge/cases/solid_block.hpp"

#include <array>

#include "compare/judge/cases/placement.hpp"
#include "compare/problem/tetrahedra.hpp"

namespace ogc::compare {

namespace {

/// The orders in which paths go from the lowest corner of a cell to its highest one, even permutations first.
constexpr std::array<std::array<std::size_t, 3>, 6> paths{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};

Mesh jittered(Random& random, const std::array<Index, 3>& cells, double size, double height) {
  const std::array<Index, 3> step{(cells[1] + 1) * (cells[2] + 1), cells[2] + 1, 1};
  Mesh mesh;
  for (Index i = 0; i <= cells[0]; ++i)
    for (Index j = 0; j <= cells[1]; ++j)
      for (Index k = 0; k <= cells[2]; ++k) {
        const Vec3 moved = placement::sum({1.0 * i, 1.0 * j, 1.0 * k}, placement::in_box(random, -0.1, 0.1));
        mesh.positions.push_back(placement::scaled({moved.x, moved.y, height * moved.z}, size));
        if (i == cells[0] || j == cells[1] || k == cells[2]) continue;
        const Index a = i * step[0] + j * step[1] + k;
        for (std::size_t p = 0; p < paths.size(); ++p) {
          const Index b = a + step[paths[p][0]], c = b + step[paths[p][1]], d = c + step[paths[p][2]];
          mesh.tetrahedra.push_back(p < 3 ? Tetrahedron{a, b, c, d} : Tetrahedron{a, c, b, d});
        }
      }
  return mesh;
}

}  // namespace

Mesh jittered_block(Random& random, double size, double height) {
  const std::array<Index, 3> cells{1 + random.below(2), 1 + random.below(2), 1 + random.below(2)};
  return jittered(random, cells, size, height);
}

Mesh jittered_surface(Random& random, double size, double height) {
  const Mesh block = jittered_block(random, size, height);
  Mesh surface{{}, boundary_triangles(block.tetrahedra), {}};
  std::vector<Index> number(block.positions.size(), -1);
  for (Triangle& triangle : surface.triangles)
    for (Index& v : triangle) {
      Index& own = number[static_cast<std::size_t>(v)];
      if (own < 0) {
        own = static_cast<Index>(surface.positions.size());
        surface.positions.push_back(block.positions[static_cast<std::size_t>(v)]);
      }
      v = own;
    }
  return surface;
}

Mesh jittered_cube(Random& random, double size, double height) { return jittered(random, {2, 2, 2}, size, height); }

}  // namespace ogc::compare
